#include "scene/mesh/polygon.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <numbers>

namespace penumbra {
namespace {

double signed_area(const std::vector<Vec3>& p, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return 0.5 * cross(Vec3d(p[b]) - Vec3d(p[a]), Vec3d(p[c]) - Vec3d(p[a])).z;
}

struct Areas {
  double sum = 0, least = INFINITY;
  std::size_t triangles = 0;
};

Areas areas_of(const std::vector<Vec3>& polygon) {
  std::vector<std::uint32_t> t;
  triangulate(polygon, t);
  Areas areas;
  areas.triangles = t.size() / 3;
  for (std::size_t i = 0; i < t.size(); i += 3) {
    const double area = signed_area(polygon, t[i], t[i + 1], t[i + 2]);
    areas.sum += area;
    areas.least = std::min(areas.least, area);
  }
  return areas;
}

/// A star of `points` tips in the plane z = 0, counter-clockwise.
std::vector<Vec3> star(int points, double inner) {
  std::vector<Vec3> polygon;
  for (int i = 0; i < 2 * points; ++i) {
    const double r = i % 2 == 0 ? 1 : inner, angle = std::numbers::pi * i / points;
    polygon.emplace_back(static_cast<float>(r * std::cos(angle)),
                         static_cast<float>(r * std::sin(angle)), 0.0f);
  }
  return polygon;
}

TEST(Polygon, SmallOnes) {
  std::vector<std::uint32_t> t;
  triangulate(std::vector<Vec3>{}, t);
  triangulate(std::vector<Vec3>(2), t);
  EXPECT_TRUE(t.empty());
  triangulate(std::vector<Vec3>(3), t);
  EXPECT_THAT(t, testing::ElementsAre(0, 1, 2));
}

TEST(Polygon, ConvexIsAFan) {
  std::vector<std::uint32_t> t;
  triangulate(std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 3, 0}}, t);
  EXPECT_THAT(t, testing::ElementsAre(0, 1, 2, 0, 2, 3));
}

TEST(Polygon, ConcaveQuadIsCutAtItsReflexCorner) {
  // An arrow head whose notch is corner 1: the diagonal must end there.
  const std::vector<Vec3> arrow{{-1, -1, 0}, {0, 0, 0}, {1, -1, 0}, {0, 2, 0}};
  const Areas areas = areas_of(arrow);
  EXPECT_EQ(areas.triangles, 2u);
  EXPECT_GT(areas.least, 0.9);
  EXPECT_NEAR(areas.sum, 2, 1e-6);
}

TEST(Polygon, ConcaveCoversItsAreaOnce) {
  for (const int points : {3, 5, 17, 200}) {
    const auto polygon = star(points, 0.3);
    const Areas areas = areas_of(polygon);
    EXPECT_EQ(areas.triangles, polygon.size() - 2);
    EXPECT_GT(areas.least, 0) << "no triangle turned over";
    EXPECT_NEAR(areas.sum, points * 0.3 * std::sin(std::numbers::pi / points), 1e-5);
  }
}

TEST(Polygon, AnyPlaneAndWinding) {
  auto polygon = star(5, 0.3);
  std::reverse(polygon.begin(), polygon.end());
  for (Vec3& p : polygon) p = {p.y * 0.6f, p.x, p.y * 0.8f};
  std::vector<std::uint32_t> t;
  triangulate(polygon, t);
  double area = 0;
  for (std::size_t i = 0; i < t.size(); i += 3) {
    const Vec3 n = cross(polygon[t[i + 1]] - polygon[t[i]], polygon[t[i + 2]] - polygon[t[i]]);
    area += 0.5 * length(n);
    EXPECT_LT(dot(n, Vec3{0.8f, 0, -0.6f}), 0) << "clockwise stays clockwise";
  }
  EXPECT_NEAR(area, 5 * 0.3 * std::sin(std::numbers::pi / 5), 1e-5);
}

TEST(Polygon, CornersInTheMiddleOfAnEdgeAreKept) {
  const std::vector<Vec3> polygon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}};
  const Areas areas = areas_of(polygon);
  EXPECT_EQ(areas.triangles, 4u);
  EXPECT_GT(areas.least, 0) << "no sliver along the edges";
  EXPECT_NEAR(areas.sum, 4, 1e-6);
}

TEST(Polygon, HoleJoinedByASeam) {
  const std::vector<Vec3> polygon{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                                  {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
  const Areas areas = areas_of(polygon);
  EXPECT_GE(areas.least, 0);
  EXPECT_NEAR(areas.sum, 12, 1e-6);
}

TEST(Polygon, SelfCrossingAndHugeOnesEnd) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(areas_of(std::vector<Vec3>(1000)).triangles, 998u);
  std::vector<Vec3> pentagram, spiral;
  for (int i = 0; i < 5; ++i)
    pentagram.emplace_back(std::cos(2.513f * static_cast<float>(i)),
                           std::sin(2.513f * static_cast<float>(i)), 0.0f);
  EXPECT_EQ(areas_of(pentagram).triangles, 3u);
  for (int i = 0; i < 20000; ++i) {
    const float angle = 0.7f * static_cast<float>(i), r = static_cast<float>(i % 777);
    spiral.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0f);
  }
  EXPECT_EQ(areas_of(spiral).triangles, 19998u);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(time.count(), 10);
}

}  // namespace
}  // namespace penumbra
