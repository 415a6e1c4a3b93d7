// What it will cost to light a tile, by either way.
#pragma once

#include <span>

#include "bake/light_sampler.h"
#include "bake/occluders.h"
#include "bake/tile.h"

namespace penumbra::bake {

struct RasterCost {
  std::size_t batch = 1;  ///< samples that best share a walk through the occluders
  float seconds = 0;      ///< one thread
};

/// A shaft from a tile of size d to samples g apart has (d² + d g + g²) / 3 for mean section, and
/// is taken to hold as large a share of the scene's triangles as it has of the scene's section.
/// Samples in one batch share the walk to the triangles, but each projects what is in the way of
/// any of them.
RasterCost raster_cost(const Occluders& occluders, const Tile& tile, const SampledLight& light);

/// Seconds by shadow rays.
float ray_cost(const Tile& tile, const SampledLight& light);

/// Seconds by OpenGL on a graphics processor: of one thread for what the processor prepares, 32
/// samples at a time, and of all `threads` for what is drawn, since that is done one after the
/// other.
float gl_cost(const Occluders& occluders, const Tile& tile, const SampledLight& light,
              std::size_t threads);

enum class Way : std::uint8_t { rays, raster, gl };

/// The cheapest for all of the lights; OpenGL where `has_gl`.
Way cheapest_way(const Occluders& occluders, const Tile& tile, std::span<const SampledLight> lights,
                 bool has_gl, std::size_t threads);

}  // namespace penumbra::bake
