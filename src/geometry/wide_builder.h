// Turns boxes into a tree with up to eight children a node, through Embree's builder.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/vec.h"
#include "geometry/cone_tree_data.h"

namespace penumbra {

/// A primitive for the builder: its box, its kind and its number among its kind.
struct BuildPrimitive {
  Bounds bounds;
  ChildKind kind = ChildKind::triangles;
  std::uint32_t index = 0;
};

/// Packs up to eight primitives of one kind, ascending by index, into leaf storage.
using PackLeaf = std::function<Child(ChildKind kind, const std::uint32_t* indices, int count)>;

/// Appends nodes to `nodes` and returns the root; kind none for no primitives.
Child build_wide_tree(const std::vector<BuildPrimitive>& primitives, HugeVector<WideNode>& nodes,
                      const PackLeaf& pack);

}  // namespace penumbra
