// How fast radiance textures are baked on the processor: the workloads of Heckbert and Herf (1997).
//   bench_bake [--quick] [--threads N] [--only rebake|light|table|scaling|samples]
//              [--model FILE]   a floor of 512² texels under it instead, one sphere light, 64
//              points
//              [--against FILE]  with --model: the same floor by another program (cycles_floor.py),
//              four floats a texel up to a factor; both are held against 65,536 points, and as
//              many are taken as it needs to be no worse
// Also prints lines "NAME<tab>VALUE" for bench/run: seconds, and ratios of what took turns.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <cstring>

#include "bake/light_sampler.h"
#include "bake/raster_baker.h"
#include "bake_scene.h"
#include "base/atomic_file.h"
#include "base/parallel.h"
#include "race.h"
#include "scene/load.h"

namespace {

using namespace penumbra;
using namespace penumbra::bench;
using namespace penumbra::bake;

ReceiverPatch patch_of(const PlanarChart& c, const BakeOptions& options) {
  const auto& scales = options.instance_scale;
  return {{c.base, c.base + c.edge_x, c.base + c.edge_x + c.edge_y, c.base + c.edge_y},
          c.normal,
          scales.empty() ? 1.0f : scales[c.instance]};
}

/// A bake from a scene's meshes to irradiance in memory, all structures built anew.
class Bake {
 public:
  /// `step`: metres that the movable mesh goes before each bake.
  explicit Bake(BakeScene scene, float step = 0.01f) : s_(std::move(scene)), step_(step) {
    for (const PlanarChart& c : s_.charts)
      out_.emplace_back(static_cast<std::size_t>(c.width) * static_cast<std::size_t>(c.height));
  }

  void operator()() {
    move();
    const Occluders occluders(s_.scene);
    const LightViews views(s_.scene);
    const LightSampler sampler(views, s_.options);
    const RasterBaker baker(occluders);
    parallel_for(s_.charts.size(), [&](std::size_t i) {
      std::vector<SampledLight> lights;
      for (std::size_t l = 0; l < s_.scene.lights.size(); ++l)
        lights.push_back(sampler.sample(l, patch_of(s_.charts[i], s_.options)));
      baker.irradiance(s_.charts[i], lights, out_[i]);
    });
  }
  const BakeScene& scene() const { return s_; }
  const std::vector<Vec3>& irradiance(std::size_t chart) const { return out_[chart]; }

 private:
  void move() {
    const float step = ++turn_ % 64 < 32 ? step_ : -step_;
    for (Vec3& p : s_.scene.meshes[s_.movable].positions) p.x += step;
  }

  BakeScene s_;
  float step_;
  std::vector<std::vector<Vec3>> out_;
  int turn_ = 0;
};

void say(const std::string& name, double value) { fmt::print("{}\t{:.6g}\n", name, value); }

void report(const std::string& what, Bake bake, int repeats) {
  const BakeScene& s = bake.scene();
  const std::string name = fmt::format("{}: {} triangles, {} receivers, {} texels", what,
                                       s.triangle_count(), s.charts.size(), s.texel_count());
  Race race;
  race.add(name, [&] { bake(); });
  race.run(repeats);
  fmt::print("{}: {:.2f} ms, {:.0f} a second\n", name, 1e3 * race.time(0), 1 / race.time(0));
  say(what, race.time(0));
}

/// Exponent of time over triangles from the first scene to the last.
void report_scaling(int repeats, int most) {
  std::vector<Bake> bakes;
  for (int polygons = 1000; polygons <= most; polygons *= 4)
    bakes.emplace_back(boxes(polygons, 8, 200000));
  Race race;
  for (Bake& b : bakes) race.add("", [&b] { b(); });
  race.run(repeats);
  for (std::size_t i = 0; i < bakes.size(); ++i) {
    const BakeScene& s = bakes[i].scene();
    fmt::print("all receive: {} triangles, {} receivers, {} texels: {:.2f} ms\n",
               s.triangle_count(), s.charts.size(), s.texel_count(), 1e3 * race.time(i));
  }
  const std::size_t last = bakes.size() - 1;
  const double size = static_cast<double>(bakes[last].scene().triangle_count()) /
                      static_cast<double>(bakes[0].scene().triangle_count());
  say("exponent", std::log(race.ratio(last, 0)) / std::log(size));
  say("largest", static_cast<double>(bakes[last].scene().triangle_count()));
}

void report_samples(int repeats) {
  std::vector<Bake> bakes;
  std::vector<int> counts;
  for (int n = 8; n <= 512; n *= 4)
    bakes.emplace_back(room(6142, n / 2, 200000)), counts.push_back(n);
  Race race;
  for (Bake& b : bakes) race.add("", [&b] { b(); });
  race.run(repeats);
  for (std::size_t i = 0; i < bakes.size(); ++i)
    fmt::print("{} samples: {:.2f} ms, {:.1f} us a sample\n", counts[i], 1e3 * race.time(i),
               1e6 * race.time(i) / counts[i]);
  const std::size_t last = bakes.size() - 1;
  say("time a sample, most / fewest", race.ratio(last, 0) * counts[0] / counts[last]);
}

/// A mesh on a floor of about twice its width, under a sphere light over its shoulder.
BakeScene floor_under(const std::string& file) {
  BakeScene s;
  s.scene = load_scene(file);
  s.scene.lights.clear();
  const Bounds b = bounds_of(s.scene);
  const Vec3 c = b.center(), size = b.size();
  const float side = 2 * std::max(size.x, size.z);
  Mesh floor;
  const Vec3 corner{c.x - side / 2, b.lo.y, c.z + side / 2};
  floor.positions = {corner, corner + Vec3{side, 0, 0}, corner + Vec3{side, 0, -side},
                     corner + Vec3{0, 0, -side}};
  floor.indices = {0, 1, 2, 0, 2, 3};
  PlanarChart chart;
  chart.instance = static_cast<std::uint32_t>(s.scene.instances.size());
  chart.triangles = {0, 1};
  chart.base = corner, chart.edge_x = {side, 0, 0}, chart.edge_y = {0, 0, -side};
  chart.normal = {0, 1, 0};
  chart.width = chart.height = 512;
  s.charts.push_back(chart);
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(s.scene.meshes.size());
  s.scene.meshes.push_back(floor);
  s.scene.instances.push_back(instance);
  Light light;
  light.type = LightType::sphere;
  light.position = c + Vec3{0.5f * side, side, 0.3f * side};
  light.radius = 0.1f * side;
  light.emission = Vec3(20);
  s.scene.lights.push_back(light);
  s.options.light_samples = 64;
  s.options.device = BakeDevice::cpu;
  return s;
}

/// Root mean square error relative to the brightest texel of the truth, after the factor that fits
/// best.
double relative_rmse(const std::vector<double>& found, const std::vector<double>& truth) {
  double product = 0, square = 0, brightest = 0, sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    product += found[i] * truth[i], square += found[i] * found[i];
    brightest = std::max(brightest, truth[i]);
  }
  const double factor = square > 0 ? product / square : 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    sum += (factor * found[i] - truth[i]) * (factor * found[i] - truth[i]);
  return std::sqrt(sum / static_cast<double>(truth.size())) / brightest;
}

std::vector<double> baked_floor(const std::string& model, int samples) {
  BakeScene scene = floor_under(model);
  scene.options.light_samples = samples;
  Bake bake(std::move(scene), 0);
  bake();
  std::vector<double> light;
  for (const Vec3& e : bake.irradiance(0)) light.push_back(double{e.x});
  return light;
}

std::vector<double> read_floats(const std::string& file) {
  const std::string bytes = read_file(file);
  std::vector<double> light;
  for (std::size_t at = 0; at + 16 <= bytes.size(); at += 16) {
    float red = 0;
    std::memcpy(&red, &bytes[at], 4);
    light.push_back(double{red});
  }
  return light;
}

/// The fewest points of 64, 128, 256 … that leave no greater error than the other program, and the
/// time that they take.
void report_against(const std::string& model, const std::string& other, int repeats) {
  const std::vector<double> truth = baked_floor(model, 1 << 16);
  const std::vector<double> theirs = read_floats(other);
  if (theirs.size() != truth.size()) {
    fmt::print(stderr, "bench_bake: {}: not 512 x 512 texels\n", other);
    std::exit(1);
  }
  const double limit = relative_rmse(theirs, truth);
  int points = 64;
  double error = relative_rmse(baked_floor(model, points), truth);
  while (error > limit && points < 1 << 14)
    error = relative_rmse(baked_floor(model, points *= 2), truth);
  BakeScene scene = floor_under(model);
  scene.options.light_samples = points;
  report("floor of no greater error", Bake(std::move(scene)), repeats);
  say("points", points);
  say("error", error);
  say("error of the other", limit);
}

}  // namespace

int main(int argc, char** argv) {
  bool quick = false;
  int threads = 0;
  std::string only, model, against;
  for (int i = 1; i < argc; ++i) {
    if (!std::strcmp(argv[i], "--quick")) quick = true;
    if (!std::strcmp(argv[i], "--only") && i + 1 < argc) only = argv[++i];
    if (!std::strcmp(argv[i], "--model") && i + 1 < argc) model = argv[++i];
    if (!std::strcmp(argv[i], "--against") && i + 1 < argc) against = argv[++i];
    if (!std::strcmp(argv[i], "--threads") && i + 1 < argc) threads = std::atoi(argv[++i]);
  }
  const ThreadLimit limit(threads);
  const int repeats = quick ? 1 : 5;
  fmt::print("{} threads\n", thread_count());
  if (!model.empty()) {
    report("floor", Bake(floor_under(model)), repeats);
    if (!against.empty()) report_against(model, against, repeats);
    return 0;
  }
  const auto wanted = [&](const char* name) { return only.empty() || only == name; };
  if (wanted("rebake")) report("rebake", Bake(room(749, 4, 200000)), repeats);
  if (wanted("light")) report("fine light", Bake(room(6142, 16, 200000)), repeats);
  if (wanted("table")) report("table", Bake(room_with_table(6142, 200000)), repeats);
  if (wanted("scaling")) report_scaling(repeats, quick ? 4000 : 64000);
  if (wanted("samples")) report_samples(repeats);
}
