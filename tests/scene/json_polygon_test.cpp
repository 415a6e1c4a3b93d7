// Polygons cut into triangles.
#include <gtest/gtest.h>

#include <numbers>

#include "scene/json/polygon.h"

namespace penumbra::json {
namespace {

using Polygon = std::vector<Vec3d>;

Polygon in_xy(std::initializer_list<Vec2> points) {
  Polygon polygon;
  for (const Vec2& p : points) polygon.emplace_back(p.x, p.y, 0);
  return polygon;
}

double shoelace_area(const Polygon& polygon) {
  Vec3d sum;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    sum += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return length(sum) / 2;
}

// n − 2 triangles that all face along the normal and together have the polygon's area can neither
// overlap nor leave a gap.
void expect_cut(const Polygon& polygon) {
  const PolygonCut cut = cut_polygon(polygon);
  ASSERT_EQ(cut.fault, "");
  ASSERT_EQ(cut.indices.size(), 3 * (polygon.size() - 2));
  double sum = 0;
  for (std::size_t i = 0; i < cut.indices.size(); i += 3) {
    const Vec3d a = polygon[cut.indices[i]], b = polygon[cut.indices[i + 1]];
    const double area = dot(cross(b - a, polygon[cut.indices[i + 2]] - a), cut.normal) / 2;
    EXPECT_GT(area, 0);
    sum += area;
  }
  EXPECT_NEAR(sum, shoelace_area(polygon), 1e-9 * sum);
}

std::string fault_of(const Polygon& polygon) { return cut_polygon(polygon).fault; }

TEST(JsonPolygon, Triangle) { expect_cut(in_xy({{0, 0}, {1, 0}, {0, 1}})); }

TEST(JsonPolygon, NormalFollowsTheWinding) {
  EXPECT_GT(cut_polygon(in_xy({{0, 0}, {1, 0}, {0, 1}})).normal.z, 0.999);
  EXPECT_LT(cut_polygon(in_xy({{0, 0}, {0, 1}, {1, 0}})).normal.z, -0.999);
}

TEST(JsonPolygon, Concave) {
  expect_cut(in_xy({{0, 0}, {4, 0}, {4, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}));
  expect_cut(in_xy({{0, 0}, {1, 3}, {0, 2}, {-1, 3}}));
}

TEST(JsonPolygon, VerticesOnStraightEdges) {
  expect_cut(in_xy({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}));
  expect_cut(in_xy({{0, 0}, {1, 0}, {2, 0}, {1, 2}}));
}

TEST(JsonPolygon, EveryOrientation) {
  for (int turn = 0; turn < 24; ++turn) {
    const double a = turn * 0.7, b = turn * 1.3;
    const Vec3d u(std::cos(a), std::sin(a), 0);
    const Vec3d v(-std::sin(a) * std::cos(b), std::cos(a) * std::cos(b), std::sin(b));
    Polygon polygon;
    for (const Vec3d& p : in_xy({{0, 0}, {4, 0}, {4, 3}, {2, 1}, {0, 3}}))
      polygon.push_back(u * p.x + v * p.y + Vec3d(7, -5, 3));
    expect_cut(polygon);
  }
}

TEST(JsonPolygon, StarsAndSpirals) {
  for (const int n : {7, 50, 1000}) {
    Polygon star, spiral;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n, radius = i % 2 ? 1.0 : 0.2 + 0.1 * (i % 3);
      star.emplace_back(radius * std::cos(angle), 0, radius * std::sin(angle));
    }
    expect_cut(star);
    // Out along one side of the arm, back along the other.
    for (int i = 0; i < n; ++i) {
      const double t = i < n / 2 ? i : n - 1 - i, angle = 0.2 * t;
      const double radius = 1 + 0.2 * angle + (i < n / 2 ? 0 : 0.3);
      spiral.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
    expect_cut(spiral);
  }
}

TEST(JsonPolygon, SmallDeviationFromThePlaneIsTaken) {
  Polygon polygon = in_xy({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  polygon[2].z = 0.02;
  EXPECT_EQ(fault_of(polygon), "");
  polygon[2].z = 0.2;
  EXPECT_EQ(fault_of(polygon), "the polygon is not planar: vertex 2 lies off its plane");
}

TEST(JsonPolygon, Faults) {
  EXPECT_EQ(fault_of({}), "the polygon has 0 vertices");
  EXPECT_EQ(fault_of(in_xy({{0, 0}, {1, 1}, {2, 2}})), "the polygon has no area");
  EXPECT_EQ(fault_of(in_xy({{0, 0}, {0, 0}, {0, 0}})), "the polygon has no area");
  const std::string meets = "the polygon crosses or touches itself: edges ";
  EXPECT_EQ(fault_of(in_xy({{0, 0}, {2, 0}, {0, 1}, {3, 1}})), meets + "1 and 3 meet");
  EXPECT_EQ(fault_of(in_xy({{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}})), meets + "0 and 2 meet");
  EXPECT_EQ(fault_of(in_xy({{0, 0}, {2, 0}, {2, 2}, {2, 1}, {0, 1}})), meets + "1 and 2 meet");
  EXPECT_EQ(fault_of(in_xy({{0, 0}, {1, 0}, {1, 0}, {0, 1}})), meets + "0 and 1 meet");
  EXPECT_EQ(fault_of(in_xy({{0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}, {1, 1}})),
            meets + "1 and 4 meet");
}

}  // namespace
}  // namespace penumbra::json
