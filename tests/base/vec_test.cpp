#include "base/vec.h"

#include <gtest/gtest.h>

#include "base/affine.h"

namespace penumbra {
namespace {

TEST(Frame, IsOrthonormalAndRightHandedInEveryDirection) {
  for (int i = 0; i < 2000; ++i) {
    const float z = 1 - (2 * static_cast<float>(i) + 1) / 2000, r = std::sqrt(1 - z * z);
    const float phi = 2.4f * static_cast<float>(i);
    const Frame f = frame_around({r * std::cos(phi), r * std::sin(phi), z});
    EXPECT_NEAR(length(f.u), 1, 1e-5);
    EXPECT_NEAR(dot(f.u, f.w), 0, 1e-5);
    EXPECT_NEAR(length(cross(f.u, f.v) - f.w), 0, 1e-5);
  }
  for (const float sign : {1.0f, -1.0f})
    EXPECT_NEAR(length(cross(frame_around({0, 0, sign}).u, frame_around({0, 0, sign}).v)), 1, 1e-6);
}

TEST(Bounds, GrowFromNothing) {
  Bounds b;
  EXPECT_TRUE(b.empty());
  EXPECT_EQ(b.size(), Vec3());
  b.grow({1, 2, 3});
  EXPECT_FALSE(b.empty());
  b.grow({-1, 5, 3});
  EXPECT_EQ(b.size(), Vec3(2, 3, 0));
  EXPECT_EQ(b.half_area(), 6);
}

const Affine kShear{{2, 0, 1}, {0.5, -3, 0}, {1, 1, 1}, {4, 5, 6}};

TEST(Affine, InverseUndoes) {
  const Affine same = inverse(kShear) * kShear;
  for (const Vec3d& p : {Vec3d(1, 2, 3), Vec3d(-4, 0, 0.25)})
    EXPECT_NEAR(length(same.point(p) - p), 0, 1e-12);
}

TEST(Affine, NormalsStayPerpendicular) {
  const Vec3d a(1, 2, 0), b(0, 1, -3);
  const Vec3d n = kShear.normal(cross(a, b));
  EXPECT_NEAR(dot(n, kShear.vector(a)), 0, 1e-12);
  EXPECT_NEAR(dot(n, kShear.vector(b)), 0, 1e-12);
}

TEST(Affine, SimilaritiesAreKnown) {
  EXPECT_TRUE(is_similarity({{0, 2, 0}, {0, 0, 2}, {2, 0, 0}, {1, 1, 1}}));
  EXPECT_TRUE(is_similarity({{-2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {}}));
  EXPECT_FALSE(is_similarity({{1, 0, 0}, {0, 2, 0}, {0, 0, 1}, {}}));
  EXPECT_FALSE(is_similarity(kShear));
}

}  // namespace
}  // namespace penumbra
