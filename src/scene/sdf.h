// Distance fields as trees of shapes, operators and transforms; f < 0 inside. Names and conventions
// are Quilez's (articles "distance functions", "smooth minimum", "domain repetition").
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/vec.h"

namespace penumbra {

enum class SdfOp : std::uint8_t {
  // shapes
  sphere,
  box,
  round_box,
  ellipsoid,
  torus,
  capped_torus,
  capsule,
  cylinder,
  capped_cone,
  cone,
  plane,
  hexagonal_prism,
  octahedron,
  link,
  extrusion,
  revolution,
  // operators
  union_,
  intersection,
  difference,
  smooth_union,
  smooth_intersection,
  smooth_difference,
  onion,
  round,
  displace,
  // transforms
  translate,
  rotate,
  scale,
  mirror,
  repeat,
  twist,
  bend,
  elongate,
};
inline constexpr int sdf_op_count = 33;

enum class SdfKind : std::uint8_t { shape, operation, transform };

/// The outline of an extrusion or revolution.
enum class SdfProfile : std::uint8_t { none, circle, box, polygon };

/// What each number of a parameter may be. All are at most 1e9 in size.
enum class SdfRule : std::uint8_t {
  any,
  positive,      ///< 1e-12 or more
  non_negative,  ///< 0 or more
  nonzero,       ///< 1e-12 or more in size, of either sign
  direction,     ///< a vector of any length but zero; stored with length 1
  angle_deg,     ///< any angle
  acute_deg,     ///< above 0, below 90
  aperture_deg,  ///< above 0, at most 180
  whole,         ///< a whole number, 0 or more; −1 stands for no limit
  axes,          ///< in the file a text such as "xz"; stored as 1 for each axis named, else 0
};

struct SdfParameter {
  const char* key;
  int count;  ///< numbers: 1 or 3
  SdfRule rule;
  bool required = true;  ///< if not, every number is `fallback` where the key is missing
  double fallback = 0;
  bool one_for_all = false;  ///< count 3: a single number stands for all three
};

/// What the file says of a node of each op and how its numbers are stored: the parameters' numbers
/// in this order, then, with a profile, the profile's: circle radius; box half_size x, y; polygon
/// x, y of each vertex.
struct SdfSignature {
  SdfOp op;
  const char* name;
  SdfKind kind;
  std::span<const SdfParameter> parameters;
  int most_children;  ///< 0, 1 or sdf_any_number; at least one unless 0
  bool has_profile = false;
  const char* meaning;  ///< half a sentence for the manual
};
inline constexpr int sdf_any_number = 1 << 30;

/// All of them, in the order of SdfOp.
std::span<const SdfSignature, sdf_op_count> sdf_signatures();
inline const SdfSignature& signature_of(SdfOp op) {
  return sdf_signatures()[static_cast<std::size_t>(op)];
}

struct SdfNode {
  SdfOp op = SdfOp::sphere;
  SdfProfile profile = SdfProfile::none;
  std::uint32_t material = 0;      ///< its own or the nearest ancestor's
  std::uint32_t first_number = 0;  ///< into SdfTree::numbers
  std::uint32_t number_count = 0;
  std::uint32_t first_child = 0;  ///< into SdfTree::nodes; children follow one another
  std::uint32_t child_count = 0;
};

/// One distance-field object. The root is node 0, and children come after their parents: a loop
/// over the nodes backwards meets children first, without recursion.
struct SdfTree {
  std::uint32_t object = 0;  ///< index into Scene::objects
  std::vector<SdfNode> nodes;
  std::vector<double> numbers;

  std::span<const double> numbers_of(const SdfNode& node) const {
    return std::span(numbers).subspan(node.first_number, node.number_count);
  }
  /// The numbers of parameter `index` of the op's signature.
  std::span<const double> parameter(const SdfNode& node, int index) const;
  /// The numbers of the profile.
  std::span<const double> profile_numbers(const SdfNode& node) const;
};

/// A box that holds all points with f ≤ 0; sides are infinite where the field is unbounded. Empty
/// if nothing can be inside.
Bounds bounds_of(const SdfTree& tree);
/// The same for every node, in its own frame.
std::vector<Bounds> bounds_of_nodes(const SdfTree& tree);

/// bounds_of where that is finite; of an unbounded union at the root the finite parts. May be
/// empty.
Bounds bounds_of_finite_parts(const SdfTree& tree);

inline bool is_finite(const Bounds& b) { return is_finite(b.lo) && is_finite(b.hi); }

/// A shader with `float map(vec3 p)` or `mainImage`, as its file has it.
struct GlslSource {
  std::string text;
  std::string path;
  std::uint32_t object = 0;  ///< index into Scene::objects
};

}  // namespace penumbra
