// Records of shapes. Internal to the room.
#pragma once

#include <optional>
#include <vector>

#include "scene/scene.h"
#include "sdf/placement.h"
#include "sdf/tape.h"

namespace penumbra::sdf {

struct Leaf {
  Op op;
  std::vector<float> constants;
};

/// Can the shape's constants take a turn, so that the point need not be turned for it?
bool takes_turn(SdfOp shape);

/// `at` must not be turned unless takes_turn.
Leaf leaf_of(const SdfTree& tree, const SdfNode& node, const Placement& at);

Leaf leaf_of(const Sphere& sphere);
/// Nothing for a mesh that is not exact.
std::optional<Leaf> leaf_of(const Mesh& mesh);

}  // namespace penumbra::sdf
