#include "bake/atlas.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

#include "bake/page.h"

namespace penumbra::bake {
namespace {

// Texels of each page that a block with its gutters takes, marked; a texel taken twice fails.
void expect_no_overlap(const std::vector<Block>& blocks, const Atlas& atlas) {
  std::vector<std::vector<int>> taken;
  for (const AtlasPage& p : atlas.pages)
    taken.emplace_back(static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height));
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const AtlasPlace& at = atlas.places[i];
    const AtlasPage& page = atlas.pages[static_cast<std::size_t>(at.page)];
    ASSERT_EQ((at.x - gutter) % alignment, 0);
    ASSERT_EQ((at.y - gutter) % alignment, 0);
    ASSERT_LE(at.x + blocks[i].width + gutter, page.width);
    ASSERT_LE(at.y + blocks[i].height + gutter, page.height);
    for (int y = at.y - gutter; y < at.y + blocks[i].height + gutter; ++y)
      for (int x = at.x - gutter; x < at.x + blocks[i].width + gutter; ++x)
        ASSERT_EQ(taken[static_cast<std::size_t>(at.page)]
                       [static_cast<std::size_t>(y) * static_cast<std::size_t>(page.width) +
                        static_cast<std::size_t>(x)]++,
                  0);
  }
}

std::vector<Block> many_blocks() {
  std::vector<Block> blocks;
  unsigned seed = 1;
  for (int i = 0; i < 300; ++i) {
    const auto next = [&] {
      return static_cast<int>((seed = seed * 1664525u + 1013904223u) >> 25);
    };
    blocks.push_back({2 + next(), 2 + next()});
  }
  return blocks;
}

TEST(Atlas, BlocksDoNotOverlap) {
  const auto blocks = many_blocks();
  const Atlas atlas = pack(blocks, false);
  EXPECT_EQ(atlas.pages.size(), 1u);
  expect_no_overlap(blocks, atlas);
}

TEST(Atlas, PagesArePowersOfTwoIfAskedFor) {
  const auto blocks = many_blocks();
  const Atlas atlas = pack(blocks, true);
  for (const AtlasPage& page : atlas.pages) {
    EXPECT_TRUE(std::has_single_bit(static_cast<unsigned>(page.width)));
    EXPECT_TRUE(std::has_single_bit(static_cast<unsigned>(page.height)));
  }
  expect_no_overlap(blocks, atlas);
}

TEST(Atlas, WhatIsTooMuchForOnePageTakesSeveral) {
  const std::vector<Block> blocks(3, {largest_page - 2 * gutter, 3000});
  const Atlas atlas = pack(blocks, false);
  EXPECT_EQ(atlas.pages.size(), 3u);
  expect_no_overlap(blocks, atlas);
}

CutChart chart_of(int width, int height, bool half = false) {
  CutChart chart;
  chart.shape.width = width, chart.shape.height = height;
  chart.half = half;
  return chart;
}

TEST(Atlas, TwoTrianglesShareABlockWhereThatPays) {
  const std::vector<CutChart> large{chart_of(200, 180, true), chart_of(190, 185, true)};
  const PlacedCharts shared = place_charts(large, false);
  EXPECT_EQ(shared.areas.size(), 1u);
  EXPECT_NE(shared.places[0].turned, shared.places[1].turned);
  const std::vector<CutChart> small{chart_of(10, 10, true), chart_of(10, 10, true)};
  EXPECT_EQ(place_charts(small, false).areas.size(), 2u);
}

// The texels of a chart that lie below the diagonal if it is a triangle's.
ChartTexels constant(const CutChart& chart, const Vec3& value) {
  ChartTexels texels;
  const auto w = static_cast<float>(chart.shape.width), h = static_cast<float>(chart.shape.height);
  for (int j = 0; j < chart.shape.height; ++j)
    for (int i = 0; i < chart.shape.width; ++i) {
      texels.value.push_back(value);
      texels.is_known.push_back(!chart.half || (static_cast<float>(i) + 0.5f) / w +
                                                       (static_cast<float>(j) + 0.5f) / h <
                                                   1);
    }
  return texels;
}

Image halved(const Image& in) {
  Image out(in.width / 2, in.height / 2, 3);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      for (int c = 0; c < 3; ++c)
        out.at(x, y)[c] = 0.25f * (in.at(2 * x, 2 * y)[c] + in.at(2 * x + 1, 2 * y)[c] +
                                   in.at(2 * x, 2 * y + 1)[c] + in.at(2 * x + 1, 2 * y + 1)[c]);
  return out;
}

float bilinear(const Image& image, float x, float y, int c) {
  const float px = x * static_cast<float>(image.width) - 0.5f;
  const float py = y * static_cast<float>(image.height) - 0.5f;
  const auto clamped = [](float v, int n) { return std::clamp(static_cast<int>(v), 0, n - 1); };
  const int i = static_cast<int>(std::floor(px)), j = static_cast<int>(std::floor(py));
  const float u = px - std::floor(px), v = py - std::floor(py);
  float sum = 0;
  for (int k = 0; k < 4; ++k) {
    const float w = (k % 2 ? u : 1 - u) * (k / 2 ? v : 1 - v);
    const int a = clamped(static_cast<float>(i + k % 2), image.width);
    const int b = clamped(static_cast<float>(j + k / 2), image.height);
    if (w > 0) sum += w * image.at(a, b)[c];
  }
  return sum;
}

// Charts of one colour each: whatever is seen within one, at any of the levels, is that colour.
void expect_no_bleeding(const std::vector<CutChart>& charts) {
  const PlacedCharts placed = place_charts(charts, false);
  ASSERT_EQ(placed.pages.size(), 1u);
  Page page(placed.pages[0]);
  const auto color = [](std::size_t i) { return static_cast<float>(i + 1); };
  for (std::size_t i = 0; i < charts.size(); ++i)
    page.put(charts[i], placed.places[i], constant(charts[i], Vec3(color(i))));
  for (const auto& area : placed.areas) page.fill(area);
  Image level = page.color();
  for (int mip = 0; mip <= 3; ++mip) {
    for (std::size_t i = 0; i < charts.size(); ++i) {
      const auto w = static_cast<float>(charts[i].shape.width);
      const auto h = static_cast<float>(charts[i].shape.height);
      for (const Vec2& at : {Vec2{0, 0}, Vec2{w, 0}, Vec2{0, h}, Vec2{w / 2, h / 2}, Vec2{w, h}}) {
        if (charts[i].half && at.x + at.y > w + h - 1) continue;
        const Vec2 p = placed.places[i].in_page(at);
        EXPECT_NEAR(bilinear(level, p.x / static_cast<float>(page.color().width),
                             p.y / static_cast<float>(page.color().height), 0),
                    color(i), 1e-4f)
            << "level " << mip << ", chart " << i << ", at " << at.x << ", " << at.y;
      }
    }
    level = halved(level);
  }
}

TEST(Atlas, NothingBleedsAtThreeMipLevels) {
  expect_no_bleeding({chart_of(37, 53), chart_of(8, 8), chart_of(9, 2), chart_of(120, 31),
                      chart_of(2, 61), chart_of(64, 64)});
}

TEST(Atlas, NothingBleedsAcrossTheDiagonalOfASharedBlock) {
  expect_no_bleeding({chart_of(200, 180, true), chart_of(190, 185, true)});
}

TEST(Page, FillsWithTheNearest) {
  const std::vector<CutChart> charts{chart_of(3, 1)};
  const PlacedCharts placed = place_charts(charts, false);
  Page page(placed.pages[0]);
  ChartTexels texels;
  texels.value = {Vec3(1.0f), Vec3(2.0f), Vec3(3.0f)};
  texels.is_known = {1, 1, 1};
  page.put(charts[0], placed.places[0], texels);
  page.fill(placed.areas[0]);
  EXPECT_EQ(page.color().at(0, 4)[0], 1);
  EXPECT_EQ(page.color().at(10, 4)[0], 3);
  EXPECT_EQ(page.color().at(5, 3)[0], 2);
}

}  // namespace
}  // namespace penumbra::bake
