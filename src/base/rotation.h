// Turns about the axes.
#pragma once

#include <numbers>

#include "base/affine.h"

namespace penumbra {

/// Counter-clockwise about axis 0, 1 or 2, seen from its tip.
inline Affine axis_rotation_deg(int axis, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  const double c = std::cos(angle), s = std::sin(angle);
  if (axis == 0) return {{1, 0, 0}, {0, c, s}, {0, -s, c}, {}};
  if (axis == 1) return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}, {}};
  return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}, {}};
}

/// About x, then y, then z.
inline Affine rotation_deg(const Vec3d& degrees) {
  return axis_rotation_deg(2, degrees.z) * axis_rotation_deg(1, degrees.y) *
         axis_rotation_deg(0, degrees.x);
}

}  // namespace penumbra
