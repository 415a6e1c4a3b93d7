// Where a node is and which way it points: all that cameras and lights take from a transform.
#pragma once

#include <optional>

#include "base/affine.h"

namespace penumbra::gltf {

struct Axes {
  Vec3d origin;
  Vec3d x, y, z;     ///< orthonormal: z along the node's z, y in its y-z plane
  double scale = 1;  ///< the length of the longest of the node's axes
};

/// No value if the y or z axis has no direction, or both have the same.
inline std::optional<Axes> axes_of(const Affine& world_from_node) {
  const Affine& a = world_from_node;
  Axes axes;
  axes.origin = a.t;
  axes.scale = std::max(length(a.x), std::max(length(a.y), length(a.z)));
  axes.z = normalize(a.z);
  axes.x = normalize(cross(normalize(a.y), axes.z));
  axes.y = cross(axes.z, axes.x);
  // A zero length has made a NaN by now.
  if (!is_finite(axes.x) || !is_finite(axes.y) || !is_finite(axes.origin)) return std::nullopt;
  return axes;
}

}  // namespace penumbra::gltf
