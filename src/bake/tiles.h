// A chart cut into tiles.
#pragma once

#include "bake/tile.h"
#include "base/parallel.h"

namespace penumbra::bake {

/// Calls body(tile) for the tiles of a chart, about equal and at most most_width × most_height, in
/// parallel.
template <class Body>
void for_tiles(const PlanarChart& chart, int most_width, int most_height, const Body& body) {
  const auto piece = [](int size, int count, int k) {
    return static_cast<int>(std::int64_t{size} * k / count);
  };
  const int columns = (chart.width + most_width - 1) / most_width;
  const int rows = (chart.height + most_height - 1) / most_height;
  const auto tile = [&](std::size_t k) {
    const int i = static_cast<int>(k) % columns, j = static_cast<int>(k) / columns;
    const int column = piece(chart.width, columns, i), row = piece(chart.height, rows, j);
    body(Tile(chart, column, row, piece(chart.width, columns, i + 1) - column,
              piece(chart.height, rows, j + 1) - row));
  };
  const auto count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  if (count == 1)
    tile(0);
  else
    parallel_for(count, tile);
}

/// Of a tile's first texel in the chart's rows.
inline std::size_t first_texel(const PlanarChart& chart, const Tile& tile) {
  return static_cast<std::size_t>(tile.first_row) * chart.width + tile.first_column;
}

}  // namespace penumbra::bake
