// Parallelograms round surfaces (Heckbert and Herf 1997, section 3.4).
#pragma once

#include <span>

#include "base/vec.h"

namespace penumbra::bake {

struct Parallelogram {
  Vec3 base, edge_x, edge_y;  ///< world, metres; edge_x × edge_y along the normal it was made for
  bool exact = false;         ///< the points' outline is this parallelogram
  bool half = false;          ///< it is the half below the diagonal from edge_x to edge_y
};

/// The parallelogram round points, projected along the unit `normal` onto the plane through the
/// first: exact if their convex hull is a parallelogram, its lower left half if that is a triangle,
/// the smallest rectangle otherwise (and for slivers, whose texels would be sheared beyond use).
/// At least three points that are not on one line.
Parallelogram fit_parallelogram(std::span<const Vec3> points, const Vec3& normal);

}  // namespace penumbra::bake
