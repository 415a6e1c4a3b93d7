// A light as its shadow methods see it from one point: design words "centre", A, D, w.
#pragma once

#include <optional>

#include "base/vec.h"
#include "geometry/world.h"

namespace penumbra {

struct LightView {
  Vec3 direction;            ///< unit, from the point to the light's centre
  float distance = INFINITY; ///< A, to the centre; infinite for a sun
  float diameter_over_distance = 0;  ///< D / A; a sun: 2 tan(half its angular diameter)
  /// Flat lights: what lies on or behind this plane is no occluder. Unit normal towards the point.
  struct Plane {
    Vec3 normal;
    Vec3 point;
  };
  std::optional<Plane> plane;
  int own_instance = -1;  ///< mesh light: this instance does not occlude
};

/// The view of `light` from `point`; no value for a light that has no extent to be seen (a mesh of
/// area zero) or whose centre is the point itself.
std::optional<LightView> view_of(const Scene& scene, const Light& light, const Vec3& point);

}  // namespace penumbra
