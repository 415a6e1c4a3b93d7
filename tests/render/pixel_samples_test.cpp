#include "render/pixel_samples.h"

#include <gtest/gtest.h>

#include <set>

namespace penumbra {
namespace {

TEST(PixelSamples, OneIsTheCentre) {
  const Vec2 p = pixel_sample(0, 1);
  EXPECT_EQ(p.x, 0.5f);
  EXPECT_EQ(p.y, 0.5f);
}

TEST(PixelSamples, EachCellOfEveryGridOfAPowerOfTwoHoldsOne) {
  for (int count : {2, 4, 8, 16, 64})
    for (int columns = 1; columns <= count; columns *= 2) {
      const int rows = count / columns;
      std::set<int> cells;
      for (int i = 0; i < count; ++i) {
        const Vec2 p = pixel_sample(i, count);
        cells.insert(static_cast<int>(p.y * float(rows)) * columns +
                     static_cast<int>(p.x * float(columns)));
      }
      EXPECT_EQ(cells.size(), std::size_t(count)) << columns << " columns";
    }
}

TEST(PixelSamples, EachColumnOfAnyCountHoldsOneInThePixel) {
  for (int count : {3, 5, 6, 9, 12, 25, 1000}) {
    std::set<int> columns;
    for (int i = 0; i < count; ++i) {
      const Vec2 p = pixel_sample(i, count);
      EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
      columns.insert(static_cast<int>(p.x * float(count)));
    }
    EXPECT_EQ(columns.size(), std::size_t(count));
  }
}

}  // namespace
}  // namespace penumbra
