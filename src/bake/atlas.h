// Rectangles of texels packed into pages.
#pragma once

#include <span>
#include <vector>

namespace penumbra::bake {

/// Texels round a chart's own on every side, and what blocks are aligned to.
///
/// A sample of mip level 3 at the edge of a chart lies at the middle of one of that level's texels
/// or farther in, so bilinear filtering reads no texel that reaches beyond the block: nothing
/// bleeds at levels 0 to 3.
inline constexpr int gutter = 4, alignment = 8;
inline constexpr int largest_page = 4096;

struct Block {
  int width = 0, height = 0;  ///< texels without gutters; at most largest_page − 2 gutter
};

struct AtlasPlace {
  int page = 0;
  int x = 0, y = 0;  ///< of the block's first texel, gutter excluded; rows from the top
};

struct AtlasPage {
  int width = 0, height = 0;  ///< multiples of `alignment`, at most largest_page
};

struct Atlas {
  std::vector<AtlasPlace> places;  ///< by block
  std::vector<AtlasPage> pages;
};

/// Packs by the skyline heuristic of stb_rect_pack. `power_of_two`: sides of pages are.
Atlas pack(std::span<const Block> blocks, bool power_of_two);

}  // namespace penumbra::bake
