// One tile of a receiver, lit by one light after the other.
#pragma once

#include <functional>
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

  /// Calls visit(number, above, hidden) for the light's samples in order: whether it is above the
  /// horizon, and the bits of what hides it, null where nothing does. Good until the next call.
  using SampleVisitor = std::function<void(std::size_t, bool, const BitRaster*)>;
  void for_samples(const Occluders& occluders, const Tile& tile, const OwnTriangles& own,
                   const SampledLight& light, const SampleVisitor& visit);

 private:
  void visit_batch(const Occluders& occluders, const Tile& tile, const OwnTriangles& own,
                   const SampledLight& light, std::size_t first, std::size_t count,
                   const SampleVisitor& visit);
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
