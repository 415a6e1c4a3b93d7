#include "image/srgb.h"

#include <gtest/gtest.h>

#include <cmath>

namespace penumbra {
namespace {

int rounded(float linear) {
  return static_cast<int>(std::floor(srgb_from_linear(linear) * 255 + 0.5));
}

TEST(Srgb, KnownValues) {
  EXPECT_NEAR(linear_from_srgb(0.5), 0.2140411, 1e-6);
  EXPECT_NEAR(srgb_from_linear(0.18), 0.4613561, 1e-6);
  EXPECT_NEAR(linear_from_srgb(0.02), 0.02 / 12.92, 1e-12);
}

TEST(Srgb, EveryCodeSurvivesTheRoundTrip) {
  for (int code = 0; code < 256; ++code) EXPECT_EQ(srgb_encoder()(srgb_decode_table()[code]), code);
}

TEST(Srgb, EncoderRoundsExactly) {
  for (float x = 1e-6f; x < 1; x *= 1.0003f) ASSERT_EQ(srgb_encoder()(x), rounded(x)) << x;
}

TEST(Srgb, EncoderSwitchesAtTheVeryFloat) {
  for (int code = 1; code < 256; ++code) {
    float x = static_cast<float>(linear_from_srgb((code - 0.5) / 255));
    for (int step = -3; step <= 3; ++step) {
      float y = x;
      for (int i = 0; i < std::abs(step); ++i) y = std::nextafter(y, step < 0 ? 0.0f : 1.0f);
      ASSERT_EQ(srgb_encoder()(y), rounded(y)) << code << ' ' << step;
    }
  }
}

TEST(Srgb, EncoderClampsWhatIsNoColour) {
  EXPECT_EQ(srgb_encoder()(NAN), 0);
  EXPECT_EQ(srgb_encoder()(-1.0f), 0);
  EXPECT_EQ(srgb_encoder()(-INFINITY), 0);
  EXPECT_EQ(srgb_encoder()(1.0f), 255);
  EXPECT_EQ(srgb_encoder()(INFINITY), 255);
  EXPECT_EQ(srgb_encoder()(std::nextafter(1.0f, 0.0f)), 255);
}

}  // namespace
}  // namespace penumbra
