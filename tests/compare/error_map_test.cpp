#include "compare/error_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "image/srgb.h"

namespace penumbra::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Rgb8 codes(const Image& image, int x, int y) {
  Rgb8 color;
  for (int c = 0; c < 3; ++c)
    color[c] = static_cast<std::uint8_t>(std::lround(255 * srgb_from_linear(image.at(x, y)[c])));
  return color;
}

double luminance(const Rgb8& c) {
  return 0.2126 * linear_from_srgb(c[0] / 255.0) + 0.7152 * linear_from_srgb(c[1] / 255.0) +
         0.0722 * linear_from_srgb(c[2] / 255.0);
}

TEST(SignedErrorColor, IsBlueBelowWhiteAtAndOrangeAboveZero) {
  EXPECT_EQ(signed_error_color(0), (Rgb8{247, 247, 247}));
  EXPECT_EQ(signed_error_color(-0.5f), (Rgb8{5, 48, 97}));
  EXPECT_EQ(signed_error_color(0.5f), (Rgb8{127, 59, 8}));
  EXPECT_EQ(signed_error_color(0.1f), (Rgb8{254, 224, 182}));
  EXPECT_EQ(signed_error_color(0.1f, 0.1f), signed_error_color(0.5f));
  EXPECT_EQ(signed_error_color(-7), signed_error_color(-0.5f));
  EXPECT_EQ(signed_error_color(std::numeric_limits<float>::infinity()), signed_error_color(0.5f));
  EXPECT_EQ(signed_error_color(kNan), kNoSurface);
}

TEST(SignedErrorColor, DarkensAwayFromZeroAlikeOnBothSides) {
  for (float error = 0; error < 0.485f; error += 0.01f)
    for (const float sign : {-1.0f, 1.0f})
      EXPECT_GT(luminance(signed_error_color(sign * error)),
                luminance(signed_error_color(sign * (error + 0.01f))));
  for (float error = 0.05f; error <= 0.5f; error += 0.05f) {
    const Rgb8 below = signed_error_color(-error), above = signed_error_color(error);
    EXPECT_GT(below[2], below[0]);
    EXPECT_GT(above[0], above[2]);
  }
}

TEST(MagnitudeColor, IsEverLighter) {
  EXPECT_EQ(magnitude_color(-1), (Rgb8{0, 0, 4}));
  EXPECT_EQ(magnitude_color(1), (Rgb8{252, 253, 191}));
  EXPECT_EQ(magnitude_color(0.5f), (Rgb8{183, 55, 121}));
  for (float value = 0; value < 0.995f; value += 0.01f)
    EXPECT_GT(luminance(magnitude_color(value + 0.01f)), luminance(magnitude_color(value)));
}

TEST(SignedErrorMap, ShowsTestMinusReferenceOnSurfaces) {
  Image reference(2, 2, 1), test(2, 2, 1);
  reference.data = {0.5f, 0.5f, 0.5f, kNan};
  test.data = {0.25f, 0.75f, 1, 0.5f};
  const std::vector<std::uint8_t> surface{1, 1, 0, 1};
  const Image map = signed_error_map(reference, test, surface);
  EXPECT_EQ(codes(map, 0, 0), signed_error_color(-0.25f));
  EXPECT_EQ(codes(map, 1, 0), signed_error_color(0.25f));
  EXPECT_EQ(codes(map, 0, 1), kNoSurface);
  EXPECT_EQ(codes(map, 1, 1), kNoSurface);
  EXPECT_EQ(codes(signed_error_map(reference, test), 0, 1), signed_error_color(0.5f));
}

TEST(MagnitudeMap, ColorsEachValue) {
  Image values(2, 1, 1);
  values.data = {0.25f, 1};
  EXPECT_EQ(codes(magnitude_map(values), 0, 0), magnitude_color(0.25f));
  EXPECT_EQ(codes(magnitude_map(values), 1, 0), magnitude_color(1));
}

TEST(Legends, RunFromLeftToRight) {
  const Image signed_bar = signed_error_legend(101, 3), bar = magnitude_legend(101, 3);
  EXPECT_EQ(codes(signed_bar, 50, 1), signed_error_color(0));
  for (const int x : {0, 30, 100}) {
    const float at = (static_cast<float>(x) + 0.5f) / 101;
    EXPECT_EQ(codes(signed_bar, x, 2), signed_error_color(at - 0.5f));
    EXPECT_EQ(codes(bar, x, 0), magnitude_color(at));
  }
}

}  // namespace
}  // namespace penumbra::test
