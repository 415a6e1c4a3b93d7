// The wide tree in memory. Private to the geometry room.
#pragma once

#include <vector>

#include "geometry/alpha_mask.h"
#include "geometry/cone_tree.h"
#include "geometry/huge_pages.h"

namespace penumbra {

enum class ChildKind : std::uint32_t {
  none,
  node,
  triangles,
  spheres,
  placement,  ///< an instance's subtree
  cut_out     ///< one triangle of a material with holes
};

/// What a child of a node is: three bits of kind above 29 of index.
struct Child {
  std::uint32_t bits = 0;
  static Child of(ChildKind kind, std::size_t index) {
    return {static_cast<std::uint32_t>(kind) << 29 | static_cast<std::uint32_t>(index)};
  }
  ChildKind kind() const { return static_cast<ChildKind>(bits >> 29); }
  std::uint32_t index() const { return bits & 0x1fffffffu; }
};

constexpr int tree_width = 8;

/// Eight children's boxes side by side. An unused child's box is inside out.
struct alignas(32) WideNode {
  float lo[3][tree_width];
  float hi[3][tree_width];
  Child child[tree_width];
};

/// Up to eight triangles side by side; unused lanes repeat the first one.
struct alignas(32) TriangleLeaf {
  float position[3][3][tree_width];  ///< [vertex][axis][lane]
  std::uint32_t id[tree_width];      ///< number of the triangle in this tree
};

struct alignas(32) SphereLeaf {
  float center[3][tree_width];
  float radius[tree_width];
  std::uint32_t object[tree_width];
};

/// An instance's subtree, in the mesh's frame.
struct Placement {
  Child root;
  std::uint32_t instance = 0;
  Affine mesh_from_world;  ///< a similarity
  float mesh_scale = 1;    ///< metres of the mesh per metre of the world
};

struct CutOut {
  Vec3 position[3];  ///< world
  std::uint32_t instance = 0;
  std::uint32_t triangle = 0;
  float world_scale = 1;  ///< metres of the world per metre of the mesh, by area
};

/// Triangles first … of the tree's numbering are those of one instance.
struct TriangleRange {
  std::uint32_t first = 0;
  std::uint32_t instance = 0;
};

struct ConeTree::Data {
  const Scene* scene = nullptr;
  AlphaMasks masks;
  HugeVector<WideNode> nodes;
  HugeVector<TriangleLeaf> triangles;
  std::vector<SphereLeaf> spheres;
  std::vector<Placement> placements;
  std::vector<CutOut> cut_outs;
  std::vector<TriangleRange> ranges;  ///< ascending by first; the last one ends the numbering
  Child root;                         ///< kind none: an empty tree
  Bounds bounds;

  explicit Data(const Scene& s) : scene(&s), masks(s) {}

  /// The instance that triangle `id` of the world's tree belongs to.
  std::uint32_t instance_of(std::uint32_t id) const;
};

}  // namespace penumbra
