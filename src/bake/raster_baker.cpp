#include "bake/raster_baker.h"

#include <algorithm>
#include <mutex>

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

void RasterBaker::fractions(const PlanarChart& chart, const SampledLight& light,
                            BakeQuantity quantity, std::span<float> out) const {
  const OwnTriangles own(chart);
  for_tiles(chart, tile_width, tile_height, [&](const Tile& tile) {
    const TexelSums& sums = tile_baker().bake(occluders_, tile, own, light, quantity);
    float* to = &out[first_texel(chart, tile)];
    for (int j = 0; j < tile.height; ++j, to += chart.width)
      for (int i = 0; i < tile.width; ++i) to[i] = std::min(sums.row(j)[i], 1.0f);
  });
}

void RasterBaker::visible_samples(const PlanarChart& chart, const SampledLight& light,
                                  SampleBits& bits) const {
  const OwnTriangles own(chart);
  std::mutex mutex;
  for_tiles(chart, tile_width, tile_height, [&](const Tile& tile) {
    const auto width = static_cast<std::size_t>(tile.width);
    SampleBits found(width * static_cast<std::size_t>(tile.height), light.samples.size());
    tile_baker().for_samples(occluders_, tile, own, light,
                             [&](std::size_t s, bool above, const BitRaster* hidden) {
                               if (!above) return;
                               for (int j = 0; j < tile.height; ++j)
                                 found.set_row(width * static_cast<std::size_t>(j), tile.width, s,
                                               hidden ? hidden->row(j) : nullptr);
                             });
    // Neighbouring tiles share bytes.
    const std::lock_guard lock(mutex);
    for (int j = 0; j < tile.height; ++j)
      bits.copy(first_texel(chart, tile) +
                    static_cast<std::size_t>(j) * static_cast<std::size_t>(chart.width),
                found, width * static_cast<std::size_t>(j), width);
  });
}

}  // namespace penumbra::bake
