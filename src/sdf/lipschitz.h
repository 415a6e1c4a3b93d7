// How steep a field can be: its Lipschitz constant, node by node. The tape compiler and the shader
// generator both divide by it.
#pragma once

#include <string>
#include <vector>

#include "scene/sdf.h"

namespace penumbra::sdf {

/// |f(a) − f(b)| ≤ constant · |a − b| in the node's own frame, f as Quilez writes it, with these
/// exceptions that keep the constant finite or the field a bound:
/// - ellipsoid: where k₀ < 1 the value is (k₀ − 1) · min(radii);
/// - twist, bend: beyond the cylinder of `reach` about the axis (y, z) at distance e from it, the
///   child's value c there becomes √(e² + max(c, 0)²).
/// Hard operators (union, intersection, difference, repeat's copies) take each child divided by its
/// constant, where that is above 1: their surface stays the same. So does the whole tree.
struct NodeSlope {
  float constant = 1;
  float reach = 0;  ///< twist, bend: infinite if the child is unbounded
};

/// For every node. Appends to `warnings` what has no known constant, by name.
std::vector<NodeSlope> slopes_of(const SdfTree& tree, const std::string& object,
                                 std::vector<std::string>& warnings);

/// For an n-ary node: are its children divided by their constants?
bool divides_children(SdfOp op);

/// repeat: 1 where the nearest copy along an axis is always the one to take (the child mirrors into
/// itself and fits its cell), 2 where its neighbour counts too, 0 where the axis does not repeat.
struct CopyCounts {
  int along[3];
};
CopyCounts copies_of(const SdfTree& tree, const SdfNode& repeat, const std::vector<Bounds>& bounds);

}  // namespace penumbra::sdf
