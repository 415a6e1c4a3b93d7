#include "compare/field_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/parallel.h"
#include "compare/pictures.h"

namespace penumbra::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(FieldErrors, ByHand) {
  const std::vector<float> reference{0, 0.002f, 0.5f, 0.25f, 0.998f, 1, 1};
  const std::vector<float> test{0.25f, 0.002f, 0.75f, 0.125f, 0.498f, 1, 0.75f};
  const FieldErrors errors = field_errors(reference, test);
  EXPECT_EQ(errors.points, 7u);
  EXPECT_EQ(errors.penumbra_points, 2u);
  EXPECT_EQ(errors.far_off, 5u);
  EXPECT_NEAR(errors.far_off_share(), 5.0 / 7, 1e-12);
  const double squares = 0.0625 + 0.0625 + 0.015625 + 0.25 + 0.0625;
  EXPECT_NEAR(errors.rmse, std::sqrt(squares / 7), 1e-7);
  EXPECT_NEAR(errors.bias, (0.25 + 0.25 - 0.125 - 0.5 - 0.25) / 7, 1e-7);
  EXPECT_NEAR(errors.penumbra_rmse, std::sqrt((0.0625 + 0.015625) / 2), 1e-7);
  EXPECT_NEAR(errors.penumbra_bias, 0.0625, 1e-7);
  EXPECT_NEAR(errors.largest, 0.5, 1e-7);
  EXPECT_NEAR(errors.leaked, 0.25, 1e-7);
  EXPECT_NEAR(errors.lost, 0.75, 1e-7);
}

TEST(FieldErrors, LeaveOutPointsWithoutASurfaceOrANumber) {
  const std::vector<float> reference{0.5f, 0.5f, kNan, 0.5f};
  const std::vector<float> test{0.75f, 1, 0, kNan};
  const std::vector<std::uint8_t> surface{1, 0, 1, 1};
  const FieldErrors errors = field_errors(reference, test, surface);
  EXPECT_EQ(errors.points, 1u);
  EXPECT_EQ(errors.rmse, 0.25);
}

TEST(FieldErrors, OfNothingAreZero) {
  const FieldErrors errors = field_errors({}, {});
  EXPECT_EQ(errors.points, 0u);
  EXPECT_EQ(errors.rmse, 0);
  EXPECT_EQ(errors.bias, 0);
  EXPECT_EQ(errors.penumbra_rmse, 0);
  EXPECT_EQ(errors.far_off_share(), 0);
}

TEST(FieldErrors, AreTheSameAtAnyThreadCount) {
  const Image reference = noise(300, 300, 1, 1), test = noise(300, 300, 1, 2);
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    const FieldErrors e = field_errors(reference.data, test.data);
    return std::vector<double>{e.rmse, e.bias, e.penumbra_rmse, e.leaked, e.lost};
  };
  EXPECT_EQ(with(1), with(3));
  // The difference of two uniform numbers has the variance 1/6; its error over 90,000 is 0.0006.
  EXPECT_NEAR(with(1)[0], std::sqrt(1.0 / 6), 0.002);
}

}  // namespace
}  // namespace penumbra::test
