// The rays of one receiver to points of one light: made and traced eight at a time.
#pragma once

#include "shadow/light_points.h"
#include "shadow/shadows.h"

namespace penumbra {

class LightRays {
 public:
  /// `unoccluded`: it is known that nothing above the horizon blocks any of them, so that none need
  /// be traced.
  LightRays(const World& world, const LightViews& lights, const Receiver& receiver,
            std::size_t light, const SamplePattern& pattern, bool unoccluded = false);
  LightRays(const LightRays&) = delete;
  LightRays& operator=(const LightRays&) = delete;

  const SamplePattern& pattern() const { return pattern_; }
  /// The pattern's table, on the disk or the square as the light has it.
  const float* table_x() const;
  const float* table_y() const;

  /// Traces the `count` points x, y of the table, which can be read up to a multiple of eight.
  /// Leaves for each eight points their targets in `targets`, if that is not null, and the bits of
  /// those that are visible in `visible`. Returns how many are. The part of a light below the
  /// horizon is hidden and costs no ray.
  int trace(const float* x, const float* y, int count, LightPacket* targets, std::uint8_t* visible,
            ShadowCounts& counts) const;

  /// The same targets without a ray.
  void make(const float* x, const float* y, int count, LightPacket* targets) const;

  /// What a trace needs to know.
  struct Setup {
    const LightPoints& points;
    const SamplePattern& pattern;
    const World* world;  ///< null: nothing blocks
    Vec3 origin;         ///< of the rays
    Vec3 normal;
    int own_instance = -1;  ///< a mesh light's, which does not block
  };

 private:
  LightPoints points_;
  SamplePattern pattern_;
  Setup setup_;
};

}  // namespace penumbra
