// Where in a scene file's tree a distance-field node stands, for people.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "scene/sdf.h"

namespace penumbra {

/// "root.children[2].child" of the steps from the root: the index in "children", −1 for a "child".
/// Of many the first are only counted.
std::string sdf_path(std::span<const std::int32_t> steps);
/// The same of a node of a tree.
std::string sdf_path(const SdfTree& tree, std::uint32_t node);

}  // namespace penumbra
