// Where in a triangle a point is.
#pragma once

#include "base/vec.h"

namespace penumbra::bake {

/// Barycentric weights of the second and third corner at p, which is in the triangle's plane or
/// projected to it; 0, 0 for a triangle without area.
inline Vec2 barycentric(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& p) {
  const Vec3d n = cross(b - a, c - a);
  const double area2 = dot(n, n);
  if (!(area2 > 0)) return {};
  return {static_cast<float>(dot(cross(p - a, c - a), n) / area2),
          static_cast<float>(dot(cross(b - a, p - a), n) / area2)};
}

}  // namespace penumbra::bake
