#include "render/pixel_samples.h"

#include <gtest/gtest.h>

#include <set>

#include "render/hash.h"

namespace penumbra {
namespace {

TEST(PixelSamples, OneIsTheCentre) {
  const Vec2 p = pixel_sample(0, 1, 1234);
  EXPECT_EQ(p.x, 0.5f);
  EXPECT_EQ(p.y, 0.5f);
}

TEST(PixelSamples, EachCellOfASquareHoldsOne) {
  for (int side : {2, 3, 4, 8})
    for (std::uint64_t pixel = 0; pixel < 50; ++pixel) {
      std::set<int> cells;
      for (int i = 0; i < side * side; ++i) {
        const Vec2 p = pixel_sample(i, side * side, mix64(pixel));
        cells.insert(static_cast<int>(p.y * float(side)) * side +
                     static_cast<int>(p.x * float(side)));
      }
      EXPECT_EQ(cells.size(), std::size_t(side * side));
    }
}

TEST(PixelSamples, EachColumnOfAnyOtherCountHoldsOneInThePixel) {
  for (int count : {2, 3, 5, 6, 8, 12, 32})
    for (std::uint64_t pixel = 0; pixel < 50; ++pixel) {
      std::multiset<float> xs;
      for (int i = 0; i < count; ++i) {
        const Vec2 p = pixel_sample(i, count, mix64(pixel));
        EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
        xs.insert(p.x);
      }
      float before = *xs.rbegin() - 1;  // round the torus every step is one column wide
      for (float x : xs) {
        EXPECT_NEAR(x - before, 1.0f / float(count), 1e-5f);
        before = x;
      }
    }
}

TEST(PixelSamples, PixelsAndSeedsDiffer) {
  const Vec2 a = pixel_sample(1, 4, mix64(7, 0)), b = pixel_sample(1, 4, mix64(8, 0)),
             c = pixel_sample(1, 4, mix64(7, 1));
  EXPECT_NE(a.x, b.x);
  EXPECT_NE(a.x, c.x);
}

}  // namespace
}  // namespace penumbra
