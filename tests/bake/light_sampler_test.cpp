#include "bake/light_sampler.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "bake/sample_grid.h"

namespace penumbra::bake {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

Scene lit_by(LightType type) {
  Scene scene;
  Light light;
  light.type = type;
  light.position = {0.5f, 3, 0.2f}, light.normal = {0, -1, 0};
  light.edge_u = {1, 0, 0}, light.edge_v = {0, 0, 1.5f};
  light.radius = 0.4f, light.direction = {0, -1, 0}, light.angular_diameter = 0.2f;
  scene.lights.push_back(light);
  return scene;
}

ReceiverPatch floor_at(float x, float y, float size) {
  return {{Vec3{x, y, 0}, Vec3{x, y, size}, Vec3{x + size, y, size}, Vec3{x + size, y, 0}},
          {0, 1, 0},
          1};
}

TEST(SampleGrid, HasAPointInEachOfNCellsOfEqualArea) {
  for (const int n : {1, 2, 7, 16, 49, 100, 256}) {
    for (const auto placement : {SamplePlacement::jittered, SamplePlacement::regular}) {
      const auto points = sample_grid(n, 1, placement, 5);
      ASSERT_EQ(points.size(), static_cast<std::size_t>(n));
      const int rows = std::max(1, static_cast<int>(std::lround(std::sqrt(n))));
      std::set<std::pair<int, int>> cells;
      for (const Vec2& p : points) {
        ASSERT_TRUE(p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1);
        const int at = std::min(static_cast<int>(p.y * static_cast<float>(n)), n - 1);
        int row = 0;
        while ((row + 1) * n / rows <= at) ++row;
        const int columns = (row + 1) * n / rows - row * n / rows;
        cells.insert(
            {row, std::min(static_cast<int>(p.x * static_cast<float>(columns)), columns - 1)});
      }
      EXPECT_EQ(cells.size(), static_cast<std::size_t>(n));
    }
  }
}

TEST(SampleGrid, IsTheSameForTheSameSeedAndOtherForAnother) {
  const auto a = sample_grid(64, 2, SamplePlacement::jittered, 1);
  const auto b = sample_grid(64, 2, SamplePlacement::jittered, 1);
  const auto c = sample_grid(64, 2, SamplePlacement::jittered, 2);
  int same = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].x, b[i].x);
    same += a[i].x == c[i].x;
  }
  EXPECT_LT(same, 8);
}

TEST(LightSampler, PointsLieOnTheLightAndStandForAllOfIt) {
  BakeOptions options;
  options.light_samples = 100;
  for (const LightType type : {LightType::rect, LightType::disk, LightType::sphere}) {
    const Scene scene = lit_by(type);
    const LightViews views(scene);
    const SampledLight light = LightSampler(views, options).sample(0, floor_at(0, 0, 1), true);
    ASSERT_EQ(light.samples.size(), 100u);
    double area = 0;
    for (const LightSample& s : light.samples) {
      const Vec3 off = s.position - scene.lights[0].position;
      area += double(s.weight);
      if (type == LightType::sphere) {
        EXPECT_NEAR(length(off), 0.4f, 1e-5f);
        EXPECT_NEAR(dot(off, s.normal), 0.4f, 1e-5f);
      } else {
        EXPECT_NEAR(off.y, 0, 1e-6f);
      }
    }
    if (type == LightType::rect) {
      EXPECT_NEAR(area, 1.5, 1e-4);
    }
    if (type == LightType::disk) {
      EXPECT_NEAR(area, pi * 0.16, 1e-4);
    }
  }
}

TEST(LightSampler, TakesSoManyThatEachStandsForLessThanTheSolidAngle) {
  const Scene scene = lit_by(LightType::rect);
  const LightViews views(scene);
  BakeOptions options;
  options.solid_angle = 0.002f;
  const LightSampler sampler(views, options);
  int last = 5000;
  for (const float depth : {-0.5f, -2.0f, -8.0f}) {
    const ReceiverPatch patch = floor_at(0, depth, 1);
    const int n = sampler.count(0, patch);
    const float d = 3 - depth;
    EXPECT_LE(1.5f / (d * d) / static_cast<float>(n), 0.002f * 1.1f);
    EXPECT_LT(n, last);
    last = n;
  }
  EXPECT_EQ(last, 16);
}

TEST(LightSampler, MultipliersActOnTheCount) {
  const Scene scene = lit_by(LightType::disk);
  const LightViews views(scene);
  BakeOptions options;
  options.light_samples = 49;
  ReceiverPatch patch = floor_at(0, 0, 1);
  EXPECT_EQ(LightSampler(views, options).count(0, patch), 49);
  patch.samples_scale = 9.0f / 49;
  EXPECT_EQ(LightSampler(views, options).count(0, patch), 9);
  options.samples_scale = 2;
  EXPECT_EQ(LightSampler(views, options).count(0, patch), 18);
}

TEST(LightSampler, LeavesOutWhatBackfaceTestsRuleOut) {
  BakeOptions options;
  options.light_samples = 64;
  const Scene scene = lit_by(LightType::rect);
  const LightViews views(scene);
  const LightSampler sampler(views, options);
  // The receiver is behind the light; the light behind the receiver; half of it behind.
  EXPECT_TRUE(sampler.sample(0, floor_at(0, 4, 1)).samples.empty());
  ReceiverPatch down = floor_at(0, 0, 1);
  down.normal = {0, -1, 0};
  EXPECT_TRUE(sampler.sample(0, down).samples.empty());
  EXPECT_EQ(sampler.sample(0, down, true).samples.size(), 64u);
  const ReceiverPatch wall{
      {Vec3{0.5f, 0, 0}, Vec3{0.5f, 1, 0}, Vec3{0.5f, 1, 1}, Vec3{0.5f, 0, 1}}, {1, 0, 0}, 1};
  const std::size_t half = sampler.sample(0, wall).samples.size();
  EXPECT_GE(half, 28u);
  EXPECT_LE(half, 36u);
}

}  // namespace
}  // namespace penumbra::bake
