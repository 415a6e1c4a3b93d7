#include "report/area_curve.h"

#include <gtest/gtest.h>

#include <cmath>

namespace penumbra::report {
namespace {

/// errors = points^−0.75, seconds in proportion.
AreaCurve smooth_curve() {
  AreaCurve curve;
  for (const double n : {1, 4, 16, 64, 256}) {
    curve.points.push_back(n);
    curve.errors.push_back(std::pow(n, -0.75));
    curve.seconds.push_back(0.01 * n);
  }
  return curve;
}

TEST(EqualArea, IsExactOnMeasuredPoints) {
  const AreaCurve curve = smooth_curve();
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const auto equal = equal_area(curve, curve.errors[i] * (1 + 1e-12));
    ASSERT_TRUE(equal);
    EXPECT_EQ(equal->points, static_cast<std::uint64_t>(curve.points[i]));
    EXPECT_NEAR(equal->seconds, curve.seconds[i], 1e-9);
  }
}

TEST(EqualArea, IsALineOfLogarithmsBetween) {
  const auto equal = equal_area(smooth_curve(), std::pow(31.5, -0.75));
  ASSERT_TRUE(equal);
  EXPECT_EQ(equal->points, 32u);
  EXPECT_NEAR(equal->seconds, 0.315, 1e-6);
}

TEST(EqualArea, GoesOnBeyondTheLast) {
  const auto equal = equal_area(smooth_curve(), std::pow(1000, -0.75));
  ASSERT_TRUE(equal);
  EXPECT_NEAR(static_cast<double>(equal->points), 1000, 1);
  AreaCurve stuck = smooth_curve();
  stuck.errors.back() = stuck.errors[3];
  // As if by chance: a quarter of the error takes 16 times the points.
  EXPECT_NEAR(static_cast<double>(equal_area(stuck, stuck.errors.back() / 4)->points), 16 * 256, 1);
}

TEST(EqualArea, IsOnePointForAnyLargerError) {
  EXPECT_EQ(equal_area(smooth_curve(), 3)->points, 1u);
}

TEST(EqualArea, IsNoneWithoutAnErrorOrACurve) {
  EXPECT_FALSE(equal_area(smooth_curve(), 0));
  EXPECT_FALSE(equal_area(smooth_curve(), NAN));
  EXPECT_FALSE(equal_area({}, 0.1));
}

}  // namespace
}  // namespace penumbra::report
