// Where a node stands while its code is written: translations, turns and uniform scales cost
// nothing at run time, for the constants of shapes take them in. Internal to the room.
#pragma once

#include "base/affine.h"

namespace penumbra::sdf {

/// x in the node's frame ↦ scale · turn(x) + offset in the frame of the point register. turn is
/// orthogonal, of determinant ±1; lengths grow by scale > 0.
struct Placement {
  Affine turn;
  Vec3d offset;
  double scale = 1;

  Vec3d point(const Vec3d& p) const { return turn.vector(p) * scale + offset; }
  bool is_turned() const { return !turn.is_identity(); }
  /// The same size, untouched otherwise.
  Placement reset() const { return {{}, {}, scale}; }
};

}  // namespace penumbra::sdf
