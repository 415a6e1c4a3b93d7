// The node hierarchy, flattened.
#pragma once

#include <vector>

#include "base/affine.h"
#include "scene/gltf/document.h"
#include "scene/gltf/poses.h"

namespace penumbra::gltf {

struct NodeTree {
  std::vector<Affine> world_from_node;  ///< per node of the file
  std::vector<char> in_scene;           ///< per node: 1 if the scene shown contains it
};

/// Transforms of all nodes in their poses, and which of them belong to the scene: the default one,
/// else the first, else (a file without scenes) all nodes. Hierarchies of any depth. Throws
/// InputError for a node with two parents, a cycle, and a scene root that is the child of a node.
NodeTree node_tree(const Document& document, const Poses& poses = {});

/// A name for messages and for things that have none of their own: the node's, else "node 3".
std::string node_name(const Document& document, std::size_t node);

}  // namespace penumbra::gltf
