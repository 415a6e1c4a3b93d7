// The surface of a field where rays met it.
#pragma once

#include <span>

#include "sdf/field.h"

namespace penumbra::sdf {

/// Where a march ended, and the unit direction in which it went.
struct MeetingPoint {
  Vec3 position;
  Vec3 direction;
};

/// How far from its true place a computed point p may be: roundings · max(|pₓ|, |p_y|, |p_z|,
/// least_size), metres.
struct PointError {
  float roundings = 0, least_size = 0;
};

/// Positions on the surface, and unit normals to where f grows, of the side that each ray met.
/// Puts the points back onto the surface: a ray's t carries the error of its whole length. Where
/// fields blend or are divided by their slope they grow slower than the way, inside perhaps slower
/// than outside (an ellipsoid's bound), so the slope is taken on the point's own side, over 64
/// errors, a difference that rounding does not spoil. Differences for a normal near an edge reach
/// round it, to a side that faces away; a little before the surface, by four times their width,
/// they do not, and such points take that normal. Three spans of one size; thread-safe.
void surfaces(const Field& field, std::span<const MeetingPoint> met, const PointError& error,
              std::span<Vec3> positions, std::span<Vec3> normals);

}  // namespace penumbra::sdf
