// What a light's samples give to the texels of a tile, and how they see it: the same for every
// rasteriser.
#pragma once

#include <cstdint>
#include <optional>

#include "bake/awkward_shapes.h"
#include "bake/raster_kernels.h"

namespace penumbra::bake {

enum class BakeQuantity : std::uint8_t {
  irradiance,
  visible_fraction,
  lit_part  ///< of the irradiance, were nothing hidden; without the cone of a spot
};

/// irradiance_of() and share_of() as functions of the texel.
TexelWeights weights_of(const Tile& tile, const SampledLight& light, const LightSample& sample,
                        BakeQuantity quantity);

/// False for samples below the receiver's horizon: they are hidden, and count as that.
bool is_above(const Tile& tile, const SampledLight& light, const LightSample& sample);

/// No value where the sample sees the tile edge on. Keeps a reference to the tile.
std::optional<SampleView> view_of(const Occluders& occluders, const Tile& tile,
                                  const SampledLight& light, const LightSample& sample,
                                  float receiver_epsilon);

/// True if finish() reads the sums of all samples' weights, hidden or not.
bool needs_whole(const SampledLight& light, BakeQuantity quantity);

/// From the sums of the weights of samples that nothing hides to irradiance per unit emission, or
/// to fractions.
void finish(const Tile& tile, const SampledLight& light, BakeQuantity quantity,
            const TexelSums& whole, TexelSums& lit);

}  // namespace penumbra::bake
