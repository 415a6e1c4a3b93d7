// Cameras that nodes of a glTF file carry.
#pragma once

#include <vector>

#include "scene/gltf/document.h"
#include "scene/gltf/node_tree.h"
#include "scene/scene.h"

namespace penumbra::gltf {

/// One camera for each node of the scene that has one, in the nodes' order, named after the camera
/// or else the node. It looks along the node's −Z with +Y up; scale does not matter. A node whose
/// transform is singular gives no camera, with a warning.
std::vector<Camera> read_cameras(Document& document, const NodeTree& tree);

}  // namespace penumbra::gltf
