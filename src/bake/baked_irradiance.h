// The direct irradiance of a scene's surfaces by the method of Heckbert and Herf (1997), Simulating
// Soft Shadows with Graphics Hardware: each light is a few points, and the hard shadows that they
// throw are added up.
#pragma once

#include <memory>

#include "bake/bake_options.h"
#include "bake/chart.h"
#include "bake/light_sampler.h"
#include "bake/sample_bits.h"
#include "geometry/world.h"

namespace penumbra::bake {

/// Thread-safe; large charts are worked on by all threads, many small ones are best asked for from
/// many. The same bytes at any number of threads. Keeps a reference to the world.
class BakedIrradiance final : public Irradiance {
 public:
  BakedIrradiance(const World& world, const BakeOptions& options);
  ~BakedIrradiance() override;
  BakedIrradiance(const BakedIrradiance&) = delete;
  BakedIrradiance& operator=(const BakedIrradiance&) = delete;

  void of_chart(const PlanarChart& chart, std::span<Vec3> out) const override {
    of_chart(chart, {}, out);
  }
  /// Always by rays.
  void of_points(std::span<const SurfacePoint> points, std::span<Vec3> out) const override {
    of_points(points, {}, out);
  }
  /// By rays or, if the options say so, by shadows on the plane: the irradiance that reaches the
  /// points if nothing hides it, times the part of the plane's that arrives at their texels. Rays
  /// where a light is not wholly before the plane.
  void of_curved(const PlanarChart& plane, std::span<const SurfacePoint> points,
                 std::span<const std::size_t> texels, std::span<Vec3> out) const override {
    of_curved(plane, points, texels, {}, out);
  }
  /// By a set of the samples alone: the mean of many sets, weighted by share, is the irradiance.
  void of_chart(const PlanarChart& chart, const SampleSet& set, std::span<Vec3> out) const;
  void of_points(std::span<const SurfacePoint> points, const SampleSet& set,
                 std::span<Vec3> out) const;
  void of_curved(const PlanarChart& plane, std::span<const SurfacePoint> points,
                 std::span<const std::size_t> texels, const SampleSet& set,
                 std::span<Vec3> out) const;
  /// The points on each light for a chart; those of a curved one have more or fewer, each for
  /// itself.
  std::vector<int> sample_counts(const PlanarChart& chart, const SampleSet& set) const;

  /// The irradiance of one light, per unit of its emission.
  void unit_irradiances(const PlanarChart& chart, std::size_t light, std::span<float> out) const;
  void unit_irradiances(std::span<const SurfacePoint> points, std::size_t light,
                        std::span<float> out) const;

  /// The part of one light's irradiance that arrives, in [0, 1]: of its samples, weighted as
  /// equation (1) has them, those that are visible.
  void lit_parts(const PlanarChart& chart, std::size_t light, std::span<float> out) const;
  void lit_parts(std::span<const SurfacePoint> points, std::size_t light,
                 std::span<float> out) const;

  /// The samples of all lights for a chart; `all`: also those behind its plane.
  std::vector<SampledLight> sampled_lights(const PlanarChart& chart, bool all) const;
  /// Which of them the texels see. Not by the device gl. `bits` are 0 before.
  void visible_samples(const PlanarChart& chart, const SampledLight& light, SampleBits& bits) const;
  /// A byte for each point and sample, 1 where they see each other.
  void visible_samples(std::span<const SurfacePoint> points, const SampledLight& light,
                       std::span<std::uint8_t> out) const;

  /// The visible fraction of one light, in [0, 1], at every texel; at points.
  void visible_fractions(const PlanarChart& chart, std::size_t light, std::span<float> out) const;
  void visible_fractions(std::span<const SurfacePoint> points, std::size_t light,
                         std::span<float> out) const;

  const BakeOptions& options() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace penumbra::bake
