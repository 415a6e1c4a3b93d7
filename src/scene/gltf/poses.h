// Where animations put nodes.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

namespace penumbra::gltf {

/// In place of the node's own; empty where it keeps that. A rotation is a quaternion (x, y, z, w).
struct Pose {
  std::vector<double> translation, rotation, scale;
};

/// By node.
using Poses = std::map<std::size_t, Pose>;

}  // namespace penumbra::gltf
