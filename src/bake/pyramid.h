// The projection that maps a pyramid to a box: how a point of a light sees a parallelogram.
#pragma once

#include <optional>

#include "base/vec.h"

namespace penumbra::bake {

/// A parallelogram in the world: base, base + edge_x, base + edge_y and the corner opposite.
struct Parallelogram {
  Vec3d base, edge_x, edge_y;
};

/// The matrix M of Heckbert and Herf (1997), section 3.3, without its third row (0, 0, 0, 1). Maps
/// world points to (x, y, 1, w), and x_u = x / w, y_u = y / w, z_u = 1 / w: the parallelogram to
/// the unit square at z_u = 1, the plane parallel to it through the apex to infinity. Each of x, y
/// and w is affine: row · (p − origin) + constant.
///
/// With the apex for origin all constants are zero, and what is near the apex keeps its digits:
/// x and y vanish on planes through it too. (Only a light at infinity has others.)
struct PyramidToBox {
  Vec3d origin;
  Vec3d x, y, w;                     ///< rows
  double x_0 = 0, y_0 = 0, w_0 = 0;  ///< constants

  /// (x, y, w) of a point.
  Vec3d operator()(const Vec3d& p) const {
    const Vec3d q = p - origin;
    return {dot(x, q) + x_0, dot(y, q) + y_0, dot(w, q) + w_0};
  }
};

/// No value where the pyramid is flat: an apex in the base plane, or parallel edges.
std::optional<PyramidToBox> pyramid_to_box(const Vec3d& apex, const Parallelogram& base);

/// The limit for an apex at infinity in direction `towards`: a prism, and w = 1 everywhere.
std::optional<PyramidToBox> prism_to_box(const Vec3d& towards, const Parallelogram& base);

}  // namespace penumbra::bake
