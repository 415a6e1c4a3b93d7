// Equation (1) of Heckbert and Herf (1997) on the processor: registered projections of the scene
// onto a receiver from each sample of a light, one bit a texel, added up.
#pragma once

#include <span>

#include "bake/chart.h"
#include "bake/light_sampler.h"
#include "bake/occluders.h"
#include "bake/sample_bits.h"
#include "bake/sample_weights.h"

namespace penumbra::bake {

/// Works tile by tile, on all threads where a chart has several. Immutable; thread-safe; the same
/// bytes at any number of threads. Keeps a reference to the occluders.
class RasterBaker {
 public:
  explicit RasterBaker(const Occluders& occluders) : occluders_(occluders) {}

  /// Irradiance of all lights, W/m²; out has a value for each texel of the chart.
  void irradiance(const PlanarChart& chart, std::span<const SampledLight> lights,
                  std::span<Vec3> out) const;
  /// The visible fraction of one, or its lit part, in [0, 1].
  void fractions(const PlanarChart& chart, const SampledLight& light, BakeQuantity quantity,
                 std::span<float> out) const;
  void visible_fractions(const PlanarChart& chart, const SampledLight& light,
                         std::span<float> out) const {
    fractions(chart, light, BakeQuantity::visible_fraction, out);
  }
  /// Which of its samples the texels see; `bits` are 0 before.
  void visible_samples(const PlanarChart& chart, const SampledLight& light, SampleBits& bits) const;

 private:
  const Occluders& occluders_;
};

}  // namespace penumbra::bake
