#include "bake/raster_baker.h"

#include <algorithm>

#include "bake/tile_baker.h"
#include "base/parallel.h"

namespace penumbra::bake {
namespace {

/// Texels of a tile at most: its sums fit a second-level cache, and charts have enough of them to
/// keep all threads busy.
constexpr int tile_width = 512, tile_height = 128;

/// The sides of `count` pieces of [0, size), about equal.
int piece(int size, int count, int k) { return static_cast<int>(std::int64_t{size} * k / count); }

/// Calls body(tile) for the tiles of a chart.
template <class Body>
void for_tiles(const PlanarChart& chart, const Body& body) {
  const int columns = (chart.width + tile_width - 1) / tile_width;
  const int rows = (chart.height + tile_height - 1) / tile_height;
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

TileBaker& tile_baker() {
  thread_local TileBaker baker;
  return baker;
}

std::size_t first_texel(const PlanarChart& chart, const Tile& tile) {
  return static_cast<std::size_t>(tile.first_row) * chart.width + tile.first_column;
}

}  // namespace

void RasterBaker::irradiance(const PlanarChart& chart, std::span<const SampledLight> lights,
                             std::span<Vec3> out) const {
  const OwnTriangles own(chart);
  const auto stride = static_cast<std::size_t>(chart.width);
  for_tiles(chart, [&](const Tile& tile) {
    Vec3* to = &out[first_texel(chart, tile)];
    bool add = false;
    for (const SampledLight& light : lights) {
      if (light.samples.empty()) continue;
      const TexelSums& sums =
          tile_baker().bake(occluders_, tile, own, light, BakeQuantity::irradiance);
      emit(sums, light.emission, add, to, stride);
      add = true;
    }
    if (!add)
      for (int j = 0; j < tile.height; ++j)
        std::fill_n(to + stride * static_cast<std::size_t>(j), tile.width, Vec3());
  });
}

void RasterBaker::visible_fractions(const PlanarChart& chart, const SampledLight& light,
                                    std::span<float> out) const {
  const OwnTriangles own(chart);
  for_tiles(chart, [&](const Tile& tile) {
    const TexelSums& sums =
        tile_baker().bake(occluders_, tile, own, light, BakeQuantity::visible_fraction);
    float* to = &out[first_texel(chart, tile)];
    for (int j = 0; j < tile.height; ++j, to += chart.width)
      for (int i = 0; i < tile.width; ++i) to[i] = std::min(sums.row(j)[i], 1.0f);
  });
}

}  // namespace penumbra::bake
