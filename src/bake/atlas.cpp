#include "bake/atlas.h"

#include <algorithm>
#include <bit>
#include <cmath>

#define STBRP_STATIC
#define STB_RECT_PACK_IMPLEMENTATION
#include <stb_rect_pack.h>

namespace penumbra::bake {
namespace {

// All below counts in units of `alignment` texels.
constexpr int largest = largest_page / alignment;

int units(int texels) { return (texels + 2 * gutter + alignment - 1) / alignment; }

int up_to_power_of_two(int n) {
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::max(n, 1))));
}

std::vector<stbrp_rect> rectangles(std::span<const Block> blocks) {
  std::vector<stbrp_rect> rects;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    stbrp_rect rect{};
    rect.id = static_cast<int>(i);
    rect.w = units(blocks[i].width), rect.h = units(blocks[i].height);
    rects.push_back(rect);
  }
  return rects;
}

// A page about square for what is left.
int page_width(const std::vector<stbrp_rect>& rects, bool power_of_two) {
  double area = 0;
  int widest = 1;
  for (const stbrp_rect& r : rects) {
    area += static_cast<double>(r.w) * r.h;
    widest = std::max(widest, static_cast<int>(r.w));
  }
  const int side = std::max(widest, static_cast<int>(std::ceil(std::sqrt(1.05 * area))));
  return std::min(largest, power_of_two ? up_to_power_of_two(side) : side);
}

AtlasPage fill_page(std::vector<stbrp_rect>& rects, bool power_of_two) {
  const int width = page_width(rects, power_of_two);
  std::vector<stbrp_node> nodes(static_cast<std::size_t>(width));
  stbrp_context context;
  stbrp_init_target(&context, width, largest, nodes.data(), width);
  stbrp_pack_rects(&context, rects.data(), static_cast<int>(rects.size()));
  int used_width = 1, used_height = 1;
  for (const stbrp_rect& r : rects) {
    if (!r.was_packed) continue;
    used_width = std::max(used_width, static_cast<int>(r.x + r.w));
    used_height = std::max(used_height, static_cast<int>(r.y + r.h));
  }
  if (power_of_two) used_width = width, used_height = up_to_power_of_two(used_height);
  return {used_width * alignment, used_height * alignment};
}

}  // namespace

Atlas pack(std::span<const Block> blocks, bool power_of_two) {
  Atlas atlas;
  atlas.places.resize(blocks.size());
  std::vector<stbrp_rect> left = rectangles(blocks);
  while (!left.empty()) {
    const int page = static_cast<int>(atlas.pages.size());
    atlas.pages.push_back(fill_page(left, power_of_two));
    for (const stbrp_rect& r : left)
      if (r.was_packed)
        atlas.places[static_cast<std::size_t>(r.id)] = {page, r.x * alignment + gutter,
                                                        r.y * alignment + gutter};
    std::erase_if(left, [](const stbrp_rect& r) { return r.was_packed != 0; });
  }
  return atlas;
}

}  // namespace penumbra::bake
