// The least clearance of a ray: our own wide tree, asked with a cone.
//
// Clearance is the least of (distance of p from the ray) / (distance along the ray to p's foot)
// over all points p of the occluders: what Parker, Shirley and Smits (1998, Appendix) compute for
// one sphere as (d − R) / t₀. A cone round the ray against a box costs what a ray costs: with
// half-angle tangent k its extent along axis i at distance t is t (v_i ± k √(1 − v_i²)), so each
// slab bounds t by one division. The cone shrinks to the least clearance found so far; no box is
// ever expanded.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/alpha_mask.h"
#include "geometry/cone_query.h"
#include "scene/scene.h"

namespace penumbra {

/// What may be left out, as a function of the best answer so far.
///
/// Entry i belongs to a best clearance of (i … i+1) / size of the outer one: nothing closer to that
/// than entry i (as a fraction of the outer clearance too) need be found. All entries at the upper
/// end of their interval make the answer exact.
struct SearchLimit {
  static constexpr int size = 256;
  std::array<float, size> fraction;

  static SearchLimit exact();
};

class ConeBatch;

struct ConeCounts {
  std::uint64_t nodes = 0, leaves = 0;
};

/// The least clearance for one object.
struct ObjectClearance {
  std::uint32_t object;
  float clearance;
};

/// Immutable once built; queries are thread-safe. Refers to the scene.
class ConeTree {
 public:
  /// Instances are kept as such where copies of their triangles would be more than
  /// `most_copied_triangles` (about 60 bytes each): one tree is walked faster than a tree of trees.
  explicit ConeTree(const Scene& scene, std::size_t most_copied_triangles = std::size_t{1} << 17);
  ~ConeTree();
  ConeTree(const ConeTree&) = delete;
  ConeTree& operator=(const ConeTree&) = delete;

  /// The least clearance below query.outer, 0 if the ray itself is blocked, query.outer if there is
  /// none. Checks nothing.
  float least_clearance(const ConeQuery& query, const SearchLimit& limit, ConeCounts& counts) const;

  /// The same for many queries to one light, best in an order that keeps neighbours together:
  /// what no cone of a group touches is looked at once for all of them. With a limit that is not
  /// exact the answers may differ from those of single queries, within what the limit allows.
  /// `clearances`: as many as queries.
  void least_clearances(const ConeBatch& queries, const SearchLimit& limit,
                        std::span<float> clearances, ConeCounts& counts) const;

  /// For every object that has one the least clearance below query.outer, exactly; stops early if
  /// the ray is blocked. `out` is cleared first.
  void object_clearances(const ConeQuery& query, std::vector<ObjectClearance>& out,
                         ConeCounts& counts) const;

  std::size_t memory_bytes() const;

  struct Data;  ///< nodes and leaves: cone_tree_data.h

 private:
  std::unique_ptr<Data> data_;
};

}  // namespace penumbra
