// RasterBaker's work by OpenGL.
#pragma once

#include <memory>
#include <span>

#include "bake/chart.h"
#include "bake/light_sampler.h"
#include "bake/occluders.h"
#include "bake/sample_weights.h"

namespace penumbra::bake {

/// The same samples, matrices and occluders as RasterBaker. All threads prepare, one draws.
/// Thread-safe. Keeps a reference to the occluders.
class GlBaker {
 public:
  /// Throws WorkError where there is no driver.
  explicit GlBaker(const Occluders& occluders);
  ~GlBaker();

  /// One that draws on a graphics processor; null where there is none.
  static std::unique_ptr<GlBaker> on_graphics_processor(const Occluders& occluders);

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

 private:
  class Drawing;

  TexelSums bake(const Tile& tile, const OwnTriangles& own, const SampledLight& light,
                 BakeQuantity quantity) const;

  const Occluders& occluders_;
  std::unique_ptr<Drawing> drawing_;
};

}  // namespace penumbra::bake
