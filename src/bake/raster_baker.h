// Equation (1) of Heckbert and Herf (1997) on the processor: registered projections of the scene
// onto a receiver from each sample of a light, one bit a texel, added up.
#pragma once

#include <span>

#include "bake/chart.h"
#include "bake/light_sampler.h"
#include "bake/occluders.h"

namespace penumbra::bake {

/// Works tile by tile, on all threads where a chart has several. Immutable; thread-safe; the same
/// bytes at any number of threads. Keeps a reference to the occluders.
class RasterBaker {
 public:
  explicit RasterBaker(const Occluders& occluders) : occluders_(occluders) {}

  /// Irradiance of all lights, W/m²; out has a value for each texel of the chart.
  void irradiance(const PlanarChart& chart, std::span<const SampledLight> lights,
                  std::span<Vec3> out) const;
  /// The visible fraction of one, in [0, 1].
  void visible_fractions(const PlanarChart& chart, const SampledLight& light,
                         std::span<float> out) const;

 private:
  const Occluders& occluders_;
};

}  // namespace penumbra::bake
