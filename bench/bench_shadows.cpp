// Shadow queries against bare Embree on the same points: paired ratios within one run.
//   bench_shadows [--size N] [--repeats N] [--threads N] SCENE [LIGHT_RADIUS…]
// Points: what the scene's first camera sees, one a pixel. Each LIGHT_RADIUS, as a fraction of the
// first light's own radius, is a row; 1 if none is given.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "geometry/embree_scene.h"
#include "scene/load.h"
#include "shadow/shadows.h"

namespace penumbra {
namespace {

constexpr int points_per_light = 64;
constexpr std::size_t block = 256;

std::vector<Receiver> visible_points(const World& world, int size) {
  const Camera& camera = world.scene().cameras.front();
  const Vec3 forward = normalize(camera.look_at - camera.position);
  const Vec3 right = normalize(cross(forward, camera.up)), up = cross(right, forward);
  const float half = std::tan(camera.vertical_fov / 2);
  std::vector<Receiver> out;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const float sx = (2 * (static_cast<float>(x) + 0.5f) / static_cast<float>(size) - 1) * half;
      const float sy = (1 - 2 * (static_cast<float>(y) + 0.5f) / static_cast<float>(size)) * half;
      const Ray ray{camera.position, normalize(forward + right * sx + up * sy)};
      if (const auto hit = world.intersect(ray))
        out.push_back(receiver_of(world.surface(ray, *hit)));
    }
  return out;
}

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Timed {
  std::string name;
  std::function<void()> work;
  std::vector<double> times;
  double median() {
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
  }
};

void measure(std::vector<Timed>& all, int repeats) {
  for (Timed& t : all) t.work();  // warm-up
  for (int i = 0; i < repeats; ++i)
    for (Timed& t : all) t.times.push_back(seconds(t.work));
}

void over_blocks(std::size_t n, const std::function<void(std::size_t, std::size_t)>& body) {
  parallel_for((n + block - 1) / block,
               [&](std::size_t b) { body(b * block, std::min(n, (b + 1) * block)); });
}

// The rays that `area` traces, and that `hard` does, ready made: what Embree alone needs.
struct BareRays {
  std::vector<RTCRay> hard, area;
};

RTCRay bare(const Vec3& o, const Vec3& d, float t_max) {
  RTCRay r{};
  r.org_x = o.x, r.org_y = o.y, r.org_z = o.z, r.dir_x = d.x, r.dir_y = d.y, r.dir_z = d.z;
  r.tfar = t_max, r.mask = 0xffffffffu;
  return r;
}

BareRays bare_rays(const World& world, const Shadows& shadows,
                   const std::vector<Receiver>& points) {
  BareRays out;
  const LightSamples samples(points_per_light, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Receiver& p = points[i];
    const Vec3 origin = p.position + p.normal * world.epsilon_at(p.position);
    if (const auto view = shadows.lights().view(0, p.position);
        view && dot(view->direction, p.normal) > 0)
      out.hard.push_back(bare(origin, view->direction, view->distance));
    const LightPoints light(shadows.lights(), 0, p.position, world.epsilon_at(p.position));
    const SamplePattern pattern = samples.pattern(hash(i, 0));
    for (int k = 0; k < points_per_light; ++k) {
      const LightTarget t = light.target(pattern, k);
      const bool above = dot(t.direction, p.normal) > 0;
      out.area.push_back(bare(origin, t.direction, above ? t.t_max : -1.0f));
    }
  }
  return out;
}

void trace_single(RTCScene scene, const std::vector<RTCRay>& rays, std::size_t first,
                  std::size_t last) {
  rtc::Context context;
  rtc::init(context);
  for (std::size_t i = first; i < last; ++i) {
    if (rays[i].tfar < 0) continue;
    RTCRay ray = rays[i];
    rtc::occluded(scene, context, nullptr, ray);
  }
}

template <class Packet, int width>
void trace_packets(RTCScene scene, const std::vector<RTCRay>& rays, std::size_t first,
                   std::size_t last) {
  rtc::Context context;
  rtc::init(context);
  for (std::size_t i = first; i < last; i += width) {
    Packet p;
    alignas(64) int valid[width];
    for (std::size_t k = 0; k < width; ++k) {
      const RTCRay& r = rays[std::min(i + k, last - 1)];
      valid[k] = i + k < last && r.tfar >= 0 ? -1 : 0;
      p.org_x[k] = r.org_x, p.org_y[k] = r.org_y, p.org_z[k] = r.org_z;
      p.dir_x[k] = r.dir_x, p.dir_y[k] = r.dir_y, p.dir_z[k] = r.dir_z;
      p.tnear[k] = 0, p.tfar[k] = r.tfar, p.mask[k] = r.mask, p.time[k] = 0;
      p.id[k] = 0, p.flags[k] = 0;
    }
    rtc::occluded(valid, scene, context, nullptr, p);
  }
}

Timed by_method(const std::string& name, const World& world, ShadowOptions options,
                const std::vector<Receiver>& points) {
  auto shadows = std::make_shared<Shadows>(world, options);
  return {name,
          [shadows, &points] {
            over_blocks(points.size(), [&](std::size_t first, std::size_t last) {
              ShadowCounts counts;
              for (std::size_t i = first; i < last; ++i)
                shadows->visibility(points[i], 0, i, counts);
            });
          },
          {}};
}

Timed by_rays(const std::string& name, const std::vector<RTCRay>& rays, std::size_t grain,
              std::function<void(std::size_t, std::size_t)> trace) {
  return {name,
          [&rays, grain, trace] {
            over_blocks(rays.size() / grain, [&](std::size_t first, std::size_t last) {
              trace(first * grain, last * grain);
            });
          },
          {}};
}

void row(const Scene& original, const std::string& name, float factor, int size, int repeats) {
  Scene scene = original;
  scene.lights.front().radius *= factor;
  const World world(scene);
  const std::vector<Receiver> points = visible_points(world, size);
  ShadowOptions parker, exact, hard, area;
  exact.tolerance = 0, hard.kind = ShadowKind::hard, area.kind = ShadowKind::area;
  area.light_samples = points_per_light;
  const BareRays rays = bare_rays(world, Shadows(world, hard), points);
  const RTCScene embree = world.embree().handle();
  std::vector<Timed> all{
      by_method("parker", world, parker, points),
      by_method("exact", world, exact, points),
      by_method("hard", world, hard, points),
      by_method("area", world, area, points),
      by_rays("bare hard", rays.hard, 1,
              [&](auto a, auto b) { trace_single(embree, rays.hard, a, b); }),
      by_rays("bare hard, 8", rays.hard, 1,
              [&](auto a, auto b) { trace_packets<RTCRay8, 8>(embree, rays.hard, a, b); }),
      by_rays("bare single", rays.area, points_per_light,
              [&](auto a, auto b) { trace_single(embree, rays.area, a, b); }),
      by_rays("bare packets of 8", rays.area, points_per_light,
              [&](auto a, auto b) { trace_packets<RTCRay8, 8>(embree, rays.area, a, b); }),
      by_rays("bare packets of 16", rays.area, points_per_light,
              [&](auto a, auto b) { trace_packets<RTCRay16, 16>(embree, rays.area, a, b); })};
  measure(all, repeats);
  std::vector<double> t;
  for (Timed& timed : all) t.push_back(timed.median());
  const double best_hard = std::min(t[4], t[5]), best_area = std::min({t[6], t[7], t[8]});
  const double n = static_cast<double>(points.size()) / 1e6;
  fmt::print(
      "| {} | {:.3g} | {} | {:.2f} | {:.2f} | {:.2f} | {:.1f}x | {:.1f}x | {:.2f}x | {:.2f}x | "
      "{:.2f} | {:.2f} {:.2f} {:.2f} |\n",
      name, scene.lights.front().radius, points.size(), n / t[0], n / t[1], n / best_area,
      best_area / t[0], best_area / t[1], t[2] / best_hard, t[3] / best_area, t[0] / t[2], n / t[6],
      n / t[7], n / t[8]);
}

int run(int argc, char** argv) {
  int size = 512, repeats = 5, threads = 0;
  std::string scene_file;
  std::vector<float> factors;
  for (int i = 1; i < argc; ++i) {
    const auto option = [&](const char* name) {
      return !std::strcmp(argv[i], name) && i + 1 < argc;
    };
    if (option("--size"))
      size = std::stoi(argv[++i]);
    else if (option("--repeats"))
      repeats = std::stoi(argv[++i]);
    else if (option("--threads"))
      threads = std::stoi(argv[++i]);
    else if (scene_file.empty())
      scene_file = argv[i];
    else
      factors.push_back(std::stof(argv[i]));
  }
  if (scene_file.empty()) throw InputError("no scene is given", "name a scene file");
  if (factors.empty()) factors = {1};
  const ThreadLimit limit(threads);
  const Scene scene = load_scene(scene_file);
  const std::string name = scene_file.substr(scene_file.find_last_of('/') + 1);
  fmt::print(
      "| scene | light radius | points | parker M/s | exact M/s | 64 rays M/s | parker / 64 "
      "rays | exact / 64 rays | hard / bare | area / bare | parker / hard time | single, 8, "
      "16 M/s |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const float factor : factors) row(scene, name, factor, size, repeats);
  return 0;
}

}  // namespace
}  // namespace penumbra

int main(int argc, char** argv) {
  try {
    return penumbra::run(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "bench_shadows: {}\n", e.what());
    return 2;
  }
}
