// Shadow rays from texels and points to the samples of lights: for receivers that are not flat, and
// what the rasteriser is held against.
#pragma once

#include <span>

#include "bake/chart.h"
#include "bake/light_sampler.h"
#include "geometry/world.h"
#include "shadow/shadows.h"

namespace penumbra::bake {

/// One light at one point.
struct PointLight {
  float irradiance = 0;  ///< per unit emission
  float fraction = 0;    ///< visible fraction
  float lit_part = 0;    ///< of the irradiance, were nothing hidden; without the cone of a spot
};

/// Immutable; thread-safe. Keeps references.
class RayBaker {
 public:
  explicit RayBaker(const World& world) : world_(world) {}

  /// Occluders above the receiver's horizon alone count, short of the samples.
  PointLight light(const Receiver& receiver, const SampledLight& light) const;
  /// 1 for each sample that the receiver sees, 0 for the others.
  void visible_samples(const Receiver& receiver, const SampledLight& light,
                       std::span<std::uint8_t> out) const;
  /// Where the rays of a point begin and what bounds them: smooth surfaces by their vertex normals
  /// (receiver_of), so that facets draw no stripes at the terminator.
  Receiver receiver(const SurfacePoint& point) const;

 private:
  template <class Visit>
  void trace(const Receiver& receiver, const SampledLight& light, const Visit& visit) const;

  const World& world_;
};

}  // namespace penumbra::bake
