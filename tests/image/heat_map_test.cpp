#include "image/heat_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "image/srgb.h"

namespace penumbra {
namespace {

Image colors_of(const std::vector<float>& counts) {
  Image image(static_cast<int>(counts.size()), 1, 1);
  image.data = counts;
  return heat_map(image);
}

TEST(HeatMap, HasTheColoursOfItsScale) {
  const int codes[][3] = {
      {0, 0, 0}, {62, 48, 150}, {31, 158, 137}, {245, 197, 24}, {255, 255, 255}};
  const Image colors = colors_of({1, 4, 16, 64, 256});
  for (int i = 0; i < 5; ++i)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(srgb_encoder()(colors.at(i, 0)[c]), codes[i][c]) << i;
}

TEST(HeatMap, EndsInBlackAndWhite) {
  const Image colors = colors_of({0, -3, std::nanf(""), 1, 257, 65535, INFINITY});
  for (int i = 0; i < 7; ++i)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(colors.at(i, 0)[c], i < 4 ? 0.0f : 1.0f) << i;
}

TEST(HeatMap, MoreIsLighter) {
  std::vector<float> counts;
  for (float n = 1; n <= 256; n *= 1.05f) counts.push_back(n);
  const Image colors = colors_of(counts);
  float before = -1;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const float* c = colors.at(static_cast<int>(i), 0);
    const float luminance = 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
    EXPECT_GT(luminance, before) << counts[i];
    before = luminance;
  }
}

}  // namespace
}  // namespace penumbra
