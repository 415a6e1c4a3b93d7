// One tile of a receiver, lit by one light after the other.
#pragma once

#include <span>

#include "bake/light_sampler.h"
#include "bake/occluders.h"
#include "bake/own_triangles.h"
#include "bake/raster_kernels.h"
#include "bake/sample_weights.h"
#include "bake/tile.h"

namespace penumbra::bake {

/// Keeps its memory from tile to tile; one a thread.
class TileBaker {
 public:
  /// What arrives of one light: irradiance per unit emission, or its visible fraction.
  const TexelSums& bake(const Occluders& occluders, const Tile& tile, const OwnTriangles& own,
                        const SampledLight& light, BakeQuantity quantity);

 private:
  void add_samples(const Occluders& occluders, const Tile& tile, const OwnTriangles& own,
                   const SampledLight& light, std::span<const LightSample> samples,
                   BakeQuantity quantity, TexelSums* whole);
  /// Sets the bits of what hides the sample; false if nothing does.
  bool draw_shadow(const Occluders& occluders, const Tile& tile, const SampledLight& light,
                   const LightSample& sample, float receiver_epsilon);

  BitRaster raster_;
  TexelSums lit_, whole_;
  TriangleList triangles_;
  std::vector<MaskedTriangle> masked_;
  std::vector<Sphere> spheres_;
  std::vector<std::uint32_t> awkward_;
};

}  // namespace penumbra::bake
