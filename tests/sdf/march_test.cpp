// Rays through fields: hits against bisection of a fine scan, shadows against the plain loops.
#include <gtest/gtest.h>

#include <random>

#include "penumbra/sdf_shadow.h"
#include "sdf/march.h"
#include "sdf_scenes.h"

namespace penumbra::test {
namespace {

using namespace sdf;

Scene test_scene() {
  return scene_with(R"({"type": "sdf", "material": "a", "root": {"op": "union", "children": [
      {"shape": "plane", "normal": [0, 1, 0], "offset": 0},
      {"op": "smooth_union", "k": 0.2, "children": [
        {"shape": "sphere", "center": [-0.8, 0.6, 0.2], "radius": 0.5},
        {"shape": "torus", "center": [0.2, 0.5, 0], "major_radius": 0.5, "minor_radius": 0.15}]},
      {"op": "rotate", "rotate_deg": [20, 30, 0], "child":
        {"shape": "box", "center": [1, 0.8, -0.3], "half_size": [0.3, 0.5, 0.2]}},
      {"op": "translate", "offset": [0, 1.6, 0], "child": {"op": "twist", "rate": 2, "child":
        {"shape": "box", "half_size": [0.3, 0.3, 0.1]}}}]}},
    {"type": "sphere", "center": [-1.2, 1.8, 0.5], "radius": 0.2, "material": "b"})");
}

Vec3 random_vec(std::mt19937& random) {
  std::uniform_real_distribution<float> u(-1, 1);
  return {u(random), u(random), u(random)};
}

std::vector<MarchRay> random_rays(std::size_t count) {
  std::mt19937 random(1);
  std::vector<MarchRay> rays(count);
  for (MarchRay& ray : rays) {
    ray.origin = normalize(random_vec(random)) * 4.0f;
    ray.origin.y = std::abs(ray.origin.y) + 0.3f;
    ray.direction = normalize(random_vec(random) + Vec3(0, 0.8f, 0) - ray.origin);
    ray.t_max = 12;
  }
  return rays;
}

// The first sign change, found by plain sphere tracing with tiny steps at the end.
float scalar_trace(const Field& field, const MarchRay& ray) {
  float t = ray.t_min, before = t;
  for (int i = 0; i < 200000 && t <= ray.t_max; ++i) {
    const float h = field.distance(ray.origin + ray.direction * t);
    if (h <= 0) {
      for (int k = 0; k < 40; ++k) {
        const float middle = 0.5f * (before + t);
        (field.distance(ray.origin + ray.direction * middle) > 0 ? before : t) = middle;
      }
      return t;
    }
    before = t;
    t += std::max(h, 2e-5f);
  }
  return -1;
}

TEST(SdfMarch, HitsAreWhereTheFieldCrossesZero) {
  const Field field(test_scene());
  const auto rays = random_rays(400);
  std::vector<MarchHit> hits(rays.size()), any(rays.size());
  trace(field, rays, hits);
  occluded(field, rays, any);
  int found = 0, differ = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const float truth = scalar_trace(field, rays[i]);
    EXPECT_FALSE(hits[i].out_of_steps);
    EXPECT_EQ(hits[i].hit, any[i].hit) << i;
    found += hits[i].hit;
    if (hits[i].hit != (truth >= 0) || (hits[i].hit && std::abs(hits[i].t - truth) > 2e-4f)) {
      ++differ;
      continue;
    }
    if (!hits[i].hit) continue;
    EXPECT_LT(std::abs(field.distance(rays[i].origin + rays[i].direction * hits[i].t)), 4e-6f) << i;
  }
  EXPECT_GT(found, 200);
  EXPECT_LE(differ, 2);  // rays that graze
}

TEST(SdfMarch, StartsInside) {
  const Field field(test_scene());
  const MarchRay ray{{-0.8f, 0.6f, 0.2f}, 0, {0, 1, 0}, 5};
  MarchHit hit;
  trace(field, {&ray, 1}, {&hit, 1});
  EXPECT_TRUE(hit.hit);
  EXPECT_EQ(hit.t, 0);
}

TEST(SdfMarch, RunsOutOfSteps) {
  const Field field(test_scene());
  const MarchRay ray{{-4, 0.02f, 0.9f}, 0, {1, 0, 0}, 50};
  MarchHit hit;
  trace(field, {&ray, 1}, {&hit, 1}, {5});
  EXPECT_TRUE(hit.out_of_steps);
  EXPECT_FALSE(hit.hit);
  EXPECT_EQ(hit.steps, 5);
}

TEST(SdfMarch, ClearWaysAreClear) {
  const Field field(test_scene());
  const auto axes = random_rays(100);
  std::vector<float> way(axes.size());
  constexpr float slope = 0.02f;
  clear_ways(field, axes, slope, way);
  std::mt19937 random(2);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const Frame frame = frame_around(axes[i].direction);
    for (int k = 0; k < 8; ++k) {
      const float a = 0.785f * static_cast<float>(k);
      MarchRay ray = axes[i];
      ray.direction = normalize(frame.w + (frame.u * std::cos(a) + frame.v * std::sin(a)) * slope);
      MarchHit hit;
      trace(field, {&ray, 1}, {&hit, 1});
      EXPECT_TRUE(!hit.hit || hit.t >= way[i] * 0.9999f) << i;
    }
  }
}

std::vector<ShadowRay> shadow_rays(const Field& field) {
  std::mt19937 random(3);
  std::vector<ShadowRay> rays;
  const Vec3 light(1.5f, 4, 1);
  while (rays.size() < 300) {
    Vec3 p = random_vec(random) * 2.0f;
    p.y = 0;
    ShadowRay ray;
    ray.origin = p;
    ray.direction = normalize(light - p);
    ray.maxt = length(light - p);
    ray.w = 0.05f + 0.1f * static_cast<float>(rays.size() % 7);
    if (std::abs(field.distance(p)) < 1e-3f) rays.push_back(ray);
  }
  return rays;
}

template <class Loop>
void expect_loop(ShadowMarch kind, Loop loop) {
  const Field field(test_scene());
  const auto rays = shadow_rays(field);
  std::vector<ShadowResult> results(rays.size());
  shadow(field, kind, rays, results);
  int same_steps = 0;
  double sum = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const ShadowRay& r = rays[i];
    float nearest = 1;
    const auto along = [&](float t) {
      const float h = field.distance(r.origin + r.direction * t);
      nearest = std::min(nearest, std::abs(h));
      return h;
    };
    const sdf_shadow::Shadow truth = loop(along, r);
    // Steps of |h| come to rest on a surface, or slip through it as rounding has it.
    if (kind == ShadowMarch::inner_abs && nearest < 1e-4f) {
      ++same_steps;
      continue;
    }
    EXPECT_NEAR(results[i].visible_fraction, truth.visible_fraction, 2e-4f) << i;
    EXPECT_EQ(results[i].out_of_steps, truth.out_of_steps) << i;
    same_steps += results[i].steps == truth.steps;
    sum += results[i].visible_fraction;
  }
  EXPECT_GE(same_steps, 295);
  EXPECT_GT(sum, 20);
  EXPECT_LT(sum, 295);
}

TEST(SdfShadow, Classic) {
  expect_loop(ShadowMarch::classic, [](auto& along, const ShadowRay& r) {
    return sdf_shadow::classic(along, r.mint, r.maxt, r.w);
  });
}
TEST(SdfShadow, Improved) {
  expect_loop(ShadowMarch::improved, [](auto& along, const ShadowRay& r) {
    return sdf_shadow::improved(along, r.mint, r.maxt, r.w);
  });
}
TEST(SdfShadow, Inner) {
  expect_loop(ShadowMarch::inner, [](auto& along, const ShadowRay& r) {
    return sdf_shadow::inner(along, r.mint, r.maxt, r.w);
  });
}
TEST(SdfShadow, InnerAbs) {
  expect_loop(ShadowMarch::inner_abs, [](auto& along, const ShadowRay& r) {
    return sdf_shadow::inner_abs(along, r.mint, r.maxt, r.w);
  });
}
TEST(SdfShadow, Blog) {
  expect_loop(ShadowMarch::blog, [](auto& along, const ShadowRay& r) {
    return sdf_shadow::blog(along, r.mint, r.maxt, r.w);
  });
}

TEST(SdfShadow, StraightAboveAPlaneIsLit) {
  const Field field(scene_of(R"({"shape": "plane", "normal": [0, 1, 0]})"));
  for (const ShadowMarch kind : {ShadowMarch::classic, ShadowMarch::improved, ShadowMarch::inner}) {
    const ShadowRay ray{{0.3f, 0, 0.2f}, 0.01f, {0, 1, 0}, 10, 0.1f};
    ShadowResult result;
    shadow(field, kind, {&ray, 1}, {&result, 1});
    EXPECT_EQ(result.visible_fraction, 1);
    EXPECT_FALSE(result.out_of_steps);
  }
}

}  // namespace
}  // namespace penumbra::test
