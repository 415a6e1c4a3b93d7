// Distance fields: cost of a point, of a picture, of memory; with and without shortened code.
#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <random>

#include "base/parallel.h"
#include "field_scene.h"
#include "race.h"
#include "sdf/march.h"

using namespace penumbra;

namespace {

constexpr int width = 1280, height = 720, tile = 16;
constexpr std::size_t tiles_across = width / tile, tile_count = tiles_across * (height / tile);

struct View {
  Vec3 eye, right, up, forward;
  float scale;
  explicit View(const Camera& camera) {
    eye = camera.position;
    forward = normalize(camera.look_at - camera.position);
    right = normalize(cross(forward, Vec3(0, 1, 0)));
    up = cross(right, forward);
    scale = 2 * std::tan(0.35f) / height;
  }
  Vec3 direction(float x, float y) const {
    return normalize(forward + right * ((x - width / 2.0f) * scale) -
                     up * ((y - height / 2.0f) * scale));
  }
};

// A fourth of the tile's width and height at a time, so that neighbours share a packet.
void tile_rays(const View& view, std::size_t number, std::vector<sdf::MarchRay>& rays,
               const sdf::Field& field) {
  const auto x0 = static_cast<int>(number % tiles_across) * tile;
  const auto y0 = static_cast<int>(number / tiles_across) * tile;
  constexpr int block = 4, blocks = tile / block;
  sdf::MarchRay axes[16];
  float ways[16];
  for (int b = 0; b < blocks * blocks; ++b) {
    const auto x = static_cast<float>(x0 + b % blocks * block + block / 2);
    const auto y = static_cast<float>(y0 + b / blocks * block + block / 2);
    axes[b] = {view.eye, 0, view.direction(x, y), 40};
  }
  sdf::clear_ways(field, axes, view.scale * block * 0.75f, ways);
  rays.clear();
  for (int b = 0; b < blocks * blocks; ++b)
    for (int i = 0; i < block * block; ++i) {
      const auto x = static_cast<float>(x0 + b % blocks * block + i % block) + 0.5f;
      const auto y = static_cast<float>(y0 + b / blocks * block + i / block) + 0.5f;
      rays.push_back({view.eye, ways[b], view.direction(x, y), 40});
    }
}

struct Counts {
  std::atomic<std::uint64_t> camera_steps{0}, shadow_steps{0}, hits{0};
};

void picture(const sdf::Field& field, const View& view, bool soft, sdf::ShadowMarch kind,
             Counts* counts = nullptr) {
  const Vec3 light(3, 6, 2);
  parallel_for(tile_count, [&](std::size_t number) {
    thread_local std::vector<sdf::MarchRay> rays;
    thread_local std::vector<sdf::MarchHit> hits;
    thread_local std::vector<sdf::ShadowRay> shadow_rays;
    thread_local std::vector<sdf::ShadowResult> results;
    tile_rays(view, number, rays, field);
    hits.resize(rays.size());
    sdf::trace(field, rays, hits);
    shadow_rays.clear();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (counts) counts->camera_steps += hits[i].steps;
      if (!hits[i].hit) continue;
      const Vec3 p = rays[i].origin + rays[i].direction * hits[i].t, to = light - p;
      const float distance = length(to);
      shadow_rays.push_back({p, 0.01f, to * (1 / distance), distance, 0.05f});
    }
    if (!soft) return;
    results.resize(shadow_rays.size());
    sdf::shadow(field, kind, shadow_rays, results);
    if (!counts) return;
    counts->hits += shadow_rays.size();
    for (const auto& r : results) counts->shadow_steps += r.steps;
  });
}

void report(int count, bool smooth) {
  const Scene scene = bench::field_scene(count, smooth);
  const double build = bench::seconds([&] { sdf::Field field(scene); });
  const sdf::Field field(scene);
  sdf::FieldOptions whole;
  whole.prune = false;
  const sdf::Field full(scene, whole);
  const View view(scene.cameras[0]);
  std::vector<Vec3> points;
  std::mt19937 random(2);
  std::uniform_real_distribution<float> u(-3, 3);
  for (int i = 0; i < 4096; ++i) {
    const Vec3 base(u(random), 0.2f * std::abs(u(random)), u(random));
    for (int k = 0; k < 16; ++k) points.push_back(base + Vec3(0.002f * static_cast<float>(k)));
  }
  std::vector<float> out(points.size());
  const auto ns = [&](const sdf::Field& f) {
    const std::size_t n = &f == &full && count > 100 ? points.size() / 64 : points.size();
    const auto some = std::span(points).first(n);
    f.distance(some, std::span(out).first(n));
    double best = 1e9;
    for (int i = 0; i < 5; ++i)
      best = std::min(best, bench::seconds([&] { f.distance(some, std::span(out).first(n)); }));
    return best * 1e9 / static_cast<double>(n);
  };
  bench::Race race;
  const auto camera = race.add("camera", [&] { picture(field, view, false, {}); });
  const auto classic =
      race.add("classic", [&] { picture(field, view, true, sdf::ShadowMarch::classic); });
  const auto improved =
      race.add("improved", [&] { picture(field, view, true, sdf::ShadowMarch::improved); });
  const auto inner =
      race.add("inner", [&] { picture(field, view, true, sdf::ShadowMarch::inner); });
  race.run(5);
  Counts counts;
  picture(field, view, true, sdf::ShadowMarch::classic, &counts);
  const auto per = [](std::uint64_t n, double of) { return static_cast<double>(n) / of; };
  fmt::print(
      "{:6} {:7} {:9.1f} {:9.1f} {:8.1f} {:8.1f} {:8.1f} {:8.1f} {:8.1f} {:7.1f} {:7.1f} {:7.2f} "
      "{:6}\n",
      count, smooth ? "blended" : "union", ns(field), ns(full), 1e3 * build,
      1e3 * race.time(camera), 1e3 * race.time(classic), 1e3 * race.time(improved),
      1e3 * race.time(inner), per(counts.camera_steps, width * height),
      per(counts.shadow_steps, static_cast<double>(counts.hits)),
      static_cast<double>(field.memory_bytes()) / 1e6, field.region_codes());
}

}  // namespace

int main() {
  fmt::print("1280x720, {} threads; ns a point, ms a picture, steps a ray, MB\n", thread_count());
  fmt::print("{:>6} {:7} {:>9} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8} {:>7} {:>7} {:>7} {:>6}\n",
             "shapes", "", "pruned", "whole", "build", "camera", "classic", "improved", "inner",
             "camera", "shadow", "memory", "codes");
  for (const int count : {8, 10, 1000, 10000})
    for (const bool smooth : {false, true}) report(count, smooth);
}
