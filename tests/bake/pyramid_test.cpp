#include "bake/pyramid.h"

#include <gtest/gtest.h>

#include <random>

namespace penumbra::bake {
namespace {

struct Case {
  Vec3d apex;
  Parallelogram base;
};

std::vector<Case> cases() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-3, 3);
  const auto vector = [&] { return Vec3d{any(random), any(random), any(random)}; };
  std::vector<Case> out;
  for (int i = 0; i < 50; ++i) out.push_back({vector(), {vector(), vector(), vector()}});
  return out;
}

Vec3d unit_screen(const PyramidToBox& m, const Vec3d& p) {
  const Vec3d h = m(p);
  return {h.x / h.z, h.y / h.z, 1 / h.z};
}

void expect_near(const Vec3d& found, const Vec3d& expected) {
  EXPECT_NEAR(found.x, expected.x, 1e-9);
  EXPECT_NEAR(found.y, expected.y, 1e-9);
  EXPECT_NEAR(found.z, expected.z, 1e-9);
}

TEST(PyramidToBox, TakesTheCornersOfTheBaseToThoseOfTheBox) {
  for (const auto& [apex, b] : cases()) {
    const auto m = pyramid_to_box(apex, b);
    ASSERT_TRUE(m);
    expect_near(unit_screen(*m, b.base), {0, 0, 1});
    expect_near(unit_screen(*m, b.base + b.edge_x), {1, 0, 1});
    expect_near(unit_screen(*m, b.base + b.edge_y), {0, 1, 1});
    expect_near(unit_screen(*m, b.base + b.edge_x + b.edge_y), {1, 1, 1});
  }
}

TEST(PyramidToBox, TakesThePlaneOfTheApexToInfinity) {
  for (const auto& [apex, b] : cases()) {
    const auto m = pyramid_to_box(apex, b);
    for (const Vec3d& p : {apex, apex + b.edge_x, apex - b.edge_y * 3.0})
      EXPECT_NEAR((*m)(p).z, 0, 1e-9);
    expect_near((*m)(apex), {0, 0, 0});
  }
}

TEST(PyramidToBox, HasAffineRowsAndKeepsLinesThroughTheApex) {
  for (const auto& [apex, b] : cases()) {
    const auto m = pyramid_to_box(apex, b);
    const Vec3d p{0.3, -1.2, 0.7}, q{-2, 0.1, 1.4};
    expect_near((*m)(p * 0.25 + q * 0.75), (*m)(p)*0.25 + (*m)(q)*0.75);
    const Vec3d on_base = b.base + b.edge_x * 0.3 + b.edge_y * 0.6;
    for (const double t : {0.1, 0.5, 2.0}) {
      const Vec3d u = unit_screen(*m, apex + (on_base - apex) * t);
      EXPECT_NEAR(u.x, 0.3, 1e-9);
      EXPECT_NEAR(u.y, 0.6, 1e-9);
      EXPECT_NEAR(u.z, 1 / t, 1e-9);
    }
  }
}

TEST(PyramidToBox, IsRefusedWhereThePyramidIsFlat) {
  const Parallelogram base{{0, 0, 0}, {2, 0, 0}, {0, 0, 1}};
  EXPECT_TRUE(pyramid_to_box({0, 1e-6, 0}, base));
  EXPECT_FALSE(pyramid_to_box({5, 0, -3}, base));
  EXPECT_FALSE(pyramid_to_box({0, 0, 0}, base));
  EXPECT_FALSE(pyramid_to_box({0, 1, 0}, {{0, 0, 0}, {2, 0, 0}, {-4, 0, 0}}));
  EXPECT_FALSE(pyramid_to_box({0, 1, 0}, {{0, 0, 0}, {2, 0, 0}, {0, 0, 0}}));
  EXPECT_FALSE(prism_to_box({1, 0, 1}, base));
}

TEST(PrismToBox, IsTheLimitOfPyramids) {
  for (const auto& [towards, b] : cases()) {
    const auto m = prism_to_box(towards, b);
    ASSERT_TRUE(m);
    expect_near(unit_screen(*m, b.base + b.edge_x * 0.3 + towards * 2.0), {0.3, 0, 1});
    expect_near(unit_screen(*m, b.base + b.edge_y - towards), {0, 1, 1});
    const auto distant = pyramid_to_box(b.base + towards * 1e7, b);
    const Vec3d p{0.3, -1.2, 0.7};
    EXPECT_NEAR(length(unit_screen(*distant, p) - unit_screen(*m, p)), 0,
                1e-5 * (1 + length((*m)(p))));
  }
}

}  // namespace
}  // namespace penumbra::bake
