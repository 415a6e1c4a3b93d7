// Shadow queries against bare Embree on the same points and rays: ratios within one run.
//   bench_shadows [--size N] [--repeats N] [--threads N] [--against SCENE] SCENE [FACTOR…]
// Points: what the first camera sees, one a pixel, in 6 x 6 tiles of 32 x 32 pixels spread over a
// picture of N x N (1024), asked a tile at a time, in Morton's order as the renderer does. Each
// FACTOR of the first light's radius is a row; 1 if none is given. --against compares parker's time
// per point with that on another scene. Prints a header and rows, separated by tabs; M/s are
// million points a second. "bare" is the Embree scene that the methods use, "flat" a faster one
// (bare_embree.h); a time is compared with that of the fastest way to trace the same rays,
// "64_rays" is the fastest of flat. bare_… lists single rays and packets of 8 and 16, in the
// methods' scene; in the flat one.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "bare_embree.h"
#include "base/error.h"
#include "base/parallel.h"
#include "geometry/embree_scene.h"
#include "race.h"
#include "render/camera_rays.h"
#include "scene/load.h"
#include "shadow/shadows.h"

namespace penumbra::bench {
namespace {

constexpr int points_per_light = 64;
constexpr int tile = 32, tiles_across = 6;
constexpr std::size_t block = tile * tile;
constexpr int packets[] = {1, 8, 16};

struct Arguments {
  int size = 1024, repeats = 5, threads = 0;
  std::string scene, against;
  std::vector<float> factors;
};

void over_blocks(std::size_t n, const std::function<void(std::size_t, std::size_t)>& body) {
  parallel_for((n + block - 1) / block,
               [&](std::size_t b) { body(b * block, std::min(n, (b + 1) * block)); });
}

/// A scene with the first light's radius scaled, and the points that its first camera sees.
struct Stage {
  Stage(const Scene& original, float factor, int size) : scene(scaled(original, factor)) {
    world = std::make_unique<World>(scene);
    const CameraRays camera(scene.cameras.front(), size, size);
    const int tiles = std::max(size / tile, 1);
    const auto corner = [&](int i) { return (2 * i + 1) * tiles / (2 * tiles_across) * tile; };
    for (int i = 0; i < tiles_across * tiles_across; ++i)
      add_tile(camera, corner(i % tiles_across), corner(i / tiles_across));
  }

  void add_tile(const CameraRays& camera, int left, int top) {
    for (unsigned code = 0; code < tile * tile; ++code) {
      unsigned x = 0, y = 0;
      for (unsigned bit = 0; bit < 5; ++bit) {
        x |= (code >> (2 * bit) & 1) << bit;
        y |= (code >> (2 * bit + 1) & 1) << bit;
      }
      const Ray ray = camera
                          .at(static_cast<float>(left) + static_cast<float>(x) + 0.5f,
                              static_cast<float>(top) + static_cast<float>(y) + 0.5f)
                          .ray;
      if (const auto hit = world->intersect(ray))
        points.push_back(receiver_of(world->surface(ray, *hit)));
    }
  }
  static Scene scaled(Scene scene, float factor) {
    scene.lights.front().radius *= factor;
    return scene;
  }

  Scene scene;
  std::unique_ptr<World> world;
  std::vector<Receiver> points;
};

std::size_t add_method(Race& race, const std::string& name, const Stage& stage,
                       const ShadowOptions& options) {
  auto shadows = std::make_shared<Shadows>(*stage.world, options);
  return race.add(name, [shadows, &points = stage.points] {
    over_blocks(points.size(), [&](std::size_t first, std::size_t last) {
      ShadowCounts counts;
      thread_local std::vector<Visibility> seen;
      thread_local std::vector<std::uint64_t> streams;
      seen.resize(last - first), streams.resize(last - first);
      std::iota(streams.begin(), streams.end(), first);
      shadows->visibilities(std::span(points).subspan(first, last - first), 0, streams, seen,
                            counts);
    });
  });
}

/// Single rays and both packets; `grain` rays stay together.
std::vector<std::size_t> add_bare(Race& race, RTCScene scene, const std::vector<RTCRay>& rays,
                                  std::size_t grain) {
  std::vector<std::size_t> out;
  for (const int packet : packets) {
    const std::string name = packet == 1 ? "single" : fmt::format("packets of {}", packet);
    out.push_back(race.add(name, [scene, &rays, grain, packet] {
      over_blocks(rays.size() / grain, [&](std::size_t first, std::size_t last) {
        trace(scene, rays, first * grain, last * grain, packet);
      });
    }));
  }
  return out;
}

ShadowOptions options_of(ShadowKind kind) {
  ShadowOptions options;
  options.kind = kind;
  options.light_samples = points_per_light;
  return options;
}

/// The share of the points for which `area` traces rays at all.
double share_with_rays(const Stage& stage) {
  const Shadows area(*stage.world, options_of(ShadowKind::area));
  std::size_t traced = 0;
  for (std::size_t i = 0; i < stage.points.size(); ++i) {
    ShadowCounts counts;
    area.visibility(stage.points[i], 0, i, counts);
    traced += counts.rays > 0;
  }
  return static_cast<double>(traced) / static_cast<double>(stage.points.size());
}

void cell(const std::string& text, bool last = false) {
  fmt::print("{}{}", text, last ? '\n' : '\t');
}
void cell(double value, bool last = false) { cell(fmt::format("{:.4g}", value), last); }

/// Million points a second by single rays, packets of 8 and of 16.
std::string rates(const Race& race, const std::vector<std::size_t>& ways, double points) {
  std::string out;
  for (const auto way : ways)
    out += fmt::format("{}{:.3g}", out.empty() ? "" : " ", points / 1e6 / race.time(way));
  return out;
}

void print_header() {
  fmt::print(
      "radius\tpoints\tparker_M/s\texact_M/s\thard_M/s\t64_rays_M/s\tbest_way\tparker/64_rays\t"
      "exact/64_rays\thard/bare_time\tsame_rays/bare_time\tarea/bare_time\tshare_with_rays\t"
      "hard/flat_time\tsame_rays/"
      "flat_time\tbare_hard_M/s\tbare_64_M/s\tparker/"
      "hard_time\tagainst_time\n");
}

void print_row(const Arguments& arguments, const Scene& scene, float factor, const Stage* against) {
  const Stage stage(scene, factor, arguments.size);
  const FlatScene flat(stage.scene);
  const RTCScene robust = stage.world->embree().handle();
  ShadowOptions exact, same_rays = options_of(ShadowKind::area);
  exact.tolerance = 0, same_rays.skip_lit = false;
  const Shadows shadows(*stage.world, options_of(ShadowKind::area));
  const auto rays_of_hard = hard_rays(shadows, stage.points);
  const auto rays_of_area = area_rays(shadows, stage.points, points_per_light);
  Race race;
  const auto parker = add_method(race, "parker", stage, {});
  const auto exactly = add_method(race, "exact", stage, exact);
  const auto hard = add_method(race, "hard", stage, options_of(ShadowKind::hard));
  const auto area = add_method(race, "area", stage, options_of(ShadowKind::area));
  const auto same = add_method(race, "same rays", stage, same_rays);
  const auto flat_hard = add_bare(race, flat.handle(), rays_of_hard, 1);
  const auto flat_area = add_bare(race, flat.handle(), rays_of_area, points_per_light);
  const auto robust_hard = add_bare(race, robust, rays_of_hard, 1);
  const auto robust_area = add_bare(race, robust, rays_of_area, points_per_light);
  const auto other = against ? add_method(race, "against", *against, {}) : parker;
  race.run(arguments.repeats);

  const auto best_hard = race.fastest(flat_hard), best_area = race.fastest(flat_area);
  const auto same_hard = race.fastest(robust_hard), same_area = race.fastest(robust_area);
  const double n = static_cast<double>(stage.points.size());
  cell(stage.scene.lights.front().radius), cell(fmt::format("{}", stage.points.size()));
  for (const auto i : {parker, exactly, hard, best_area}) cell(n / 1e6 / race.time(i));
  cell(race.name(best_area));
  cell(race.ratio(best_area, parker)), cell(race.ratio(best_area, exactly));
  cell(race.ratio(hard, same_hard)), cell(race.ratio(same, same_area));
  cell(race.ratio(area, same_area)), cell(share_with_rays(stage));
  cell(race.ratio(hard, best_hard)), cell(race.ratio(same, best_area));
  for (const auto& ways : {std::pair{robust_hard, flat_hard}, std::pair{robust_area, flat_area}})
    cell(rates(race, ways.first, n) + "; " + rates(race, ways.second, n));
  cell(race.ratio(parker, hard));
  const double points_there = against ? static_cast<double>(against->points.size()) : n;
  cell(race.ratio(parker, other) * points_there / n, true);
}

Arguments parse(int argc, char** argv) {
  Arguments a;
  for (int i = 1; i < argc; ++i) {
    const auto option = [&](const char* name) {
      return !std::strcmp(argv[i], name) && i + 1 < argc;
    };
    if (option("--size"))
      a.size = std::stoi(argv[++i]);
    else if (option("--repeats"))
      a.repeats = std::stoi(argv[++i]);
    else if (option("--threads"))
      a.threads = std::stoi(argv[++i]);
    else if (option("--against"))
      a.against = argv[++i];
    else if (a.scene.empty())
      a.scene = argv[i];
    else
      a.factors.push_back(std::stof(argv[i]));
  }
  if (a.scene.empty()) throw InputError("no scene is given", "name a scene file");
  if (a.factors.empty()) a.factors = {1};
  return a;
}

void run(const Arguments& arguments) {
  const ThreadLimit limit(arguments.threads);
  const Scene scene = load_scene(arguments.scene);
  print_header();
  for (const float factor : arguments.factors) {
    std::unique_ptr<Stage> against;
    if (!arguments.against.empty())
      against = std::make_unique<Stage>(load_scene(arguments.against), factor, arguments.size);
    print_row(arguments, scene, factor, against.get());
  }
}

}  // namespace
}  // namespace penumbra::bench

int main(int argc, char** argv) {
  try {
    penumbra::bench::run(penumbra::bench::parse(argc, argv));
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "bench_shadows: {}\n", e.what());
    return 2;
  }
}
