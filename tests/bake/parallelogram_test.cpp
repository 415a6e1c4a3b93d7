#include "bake/parallelogram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace penumbra::bake {
namespace {

const Vec3 up{0, 1, 0};

float area(const Parallelogram& p) { return length(cross(p.edge_x, p.edge_y)); }

// (s, t) of a point in the plane.
Vec2 coordinates(const Parallelogram& p, const Vec3& q) {
  const Vec3 d = q - p.base, n = cross(p.edge_x, p.edge_y);
  return {dot(cross(d, p.edge_y), n) / dot(n, n), dot(cross(p.edge_x, d), n) / dot(n, n)};
}

void expect_holds(const Parallelogram& p, const std::vector<Vec3>& points) {
  for (const Vec3& q : points) {
    const Vec2 c = coordinates(p, q);
    EXPECT_GE(std::min(c.x, c.y), -1e-5f);
    EXPECT_LE(std::max(c.x, c.y), 1 + 1e-5f);
  }
  EXPECT_GT(dot(cross(p.edge_x, p.edge_y), up), 0);
}

TEST(Parallelogram, IsExactForParallelograms) {
  const Vec3 a{1, 2, 3}, u{4, 0, 1}, v{1, 0, -3};
  // With a point on a side and one inside.
  const std::vector<Vec3> points{a, a + u, a + u + v, a + v, a + u * 0.5f, a + u * 0.3f + v * 0.2f};
  const Parallelogram p = fit_parallelogram(points, up);
  EXPECT_TRUE(p.exact);
  EXPECT_NEAR(area(p), length(cross(u, v)), 1e-4f);
  expect_holds(p, points);
}

TEST(Parallelogram, TakesATriangleIntoItsLowerLeftHalf) {
  const std::vector<Vec3> points{{0, 0, 0}, {3, 0, 0}, {0, 0, -2}};
  const Parallelogram p = fit_parallelogram(points, up);
  EXPECT_TRUE(p.half);
  EXPECT_NEAR(area(p), 6, 1e-5f);
  // At the right angle.
  EXPECT_NEAR(length(p.base), 0, 1e-6f);
  for (const Vec3& q : points) EXPECT_LE(coordinates(p, q).x + coordinates(p, q).y, 1 + 1e-5f);
  expect_holds(p, points);
}

TEST(Parallelogram, IsTheSmallestRectangleOtherwise) {
  // An L of 4 by 3, turned by 30 degrees.
  const Vec3 u{std::cos(0.5236f), 0, -std::sin(0.5236f)},
      v{-std::sin(0.5236f), 0, -std::cos(0.5236f)};
  std::vector<Vec3> points;
  for (const Vec2& q : {Vec2{0, 0}, Vec2{4, 0}, Vec2{4, 1}, Vec2{1, 1}, Vec2{1, 3}, Vec2{0, 3}})
    points.push_back(u * q.x + v * q.y);
  const Parallelogram p = fit_parallelogram(points, up);
  EXPECT_FALSE(p.exact || p.half);
  EXPECT_NEAR(dot(p.edge_x, p.edge_y), 0, 1e-4f);
  EXPECT_NEAR(area(p), 12, 1e-3f);
  expect_holds(p, points);
}

TEST(Parallelogram, DoesNotShearSlivers) {
  const std::vector<Vec3> points{{0, 0, 0}, {10, 0, 0}, {20, 0, -0.1f}};
  const Parallelogram p = fit_parallelogram(points, up);
  EXPECT_NEAR(dot(p.edge_x, p.edge_y), 0, 1e-3f);
  EXPECT_GT(area(p), 0);
  expect_holds(p, points);
}

}  // namespace
}  // namespace penumbra::bake
