// The order in which a tile's pixels are taken: Morton's, so that neighbours stay together.
#pragma once

#include <array>
#include <cstdint>

#include "render/tile_renderer.h"

namespace penumbra {

/// Number `code` of the tile, from its corner.
struct TilePixel {
  std::uint8_t x, y;
};

inline constexpr auto tile_order = [] {
  std::array<TilePixel, Tile::size * Tile::size> order{};
  for (unsigned code = 0; code < order.size(); ++code) {
    unsigned x = 0, y = 0;
    for (unsigned bit = 0; bit < 5; ++bit) {
      x |= (code >> (2 * bit) & 1u) << bit;
      y |= (code >> (2 * bit + 1) & 1u) << bit;
    }
    order[code] = {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y)};
  }
  return order;
}();
static_assert(tile_order.back().x == Tile::size - 1 && tile_order.back().y == Tile::size - 1);

}  // namespace penumbra
