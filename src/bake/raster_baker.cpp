#include "bake/raster_baker.h"

#include <algorithm>

#include "bake/tile_baker.h"
#include "bake/tiles.h"

namespace penumbra::bake {
namespace {

/// Texels of a tile at most: its sums fit a second-level cache, and charts have enough of them to
/// keep all threads busy.
constexpr int tile_width = 512, tile_height = 128;

TileBaker& tile_baker() {
  thread_local TileBaker baker;
  return baker;
}

}  // namespace

void RasterBaker::irradiance(const PlanarChart& chart, std::span<const SampledLight> lights,
                             std::span<Vec3> out) const {
  const OwnTriangles own(chart);
  const auto stride = static_cast<std::size_t>(chart.width);
  for_tiles(chart, tile_width, tile_height, [&](const Tile& tile) {
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
  for_tiles(chart, tile_width, tile_height, [&](const Tile& tile) {
    const TexelSums& sums =
        tile_baker().bake(occluders_, tile, own, light, BakeQuantity::visible_fraction);
    float* to = &out[first_texel(chart, tile)];
    for (int j = 0; j < tile.height; ++j, to += chart.width)
      for (int i = 0; i < tile.width; ++i) to[i] = std::min(sums.row(j)[i], 1.0f);
  });
}

}  // namespace penumbra::bake
