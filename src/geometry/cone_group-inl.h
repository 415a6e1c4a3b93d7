// The walks of many neighbouring points together. Included once per SIMD target.
#if defined(PENUMBRA_CONE_GROUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_CONE_GROUP_INL_H
#undef PENUMBRA_CONE_GROUP_INL_H
#else
#define PENUMBRA_CONE_GROUP_INL_H
#endif

#include <algorithm>
#include <span>

#include "geometry/cone_shaft.h"
#include "geometry/cone_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::HWY_NAMESPACE {

/// Children of the tree, eight side by side, that a shaft touches: where the walks of its points
/// begin.
struct Frontier {
  static constexpr int most = 3;
  WideNode nodes[most];
  int count = 0;  ///< children

  std::span<const WideNode> all() const {
    return {nodes, static_cast<std::size_t>((count + tree_width - 1) / tree_width)};
  }
  Child child(int i) const { return nodes[i / tree_width].child[i % tree_width]; }
  bool is_full() const { return count == most * tree_width; }

  void add(const WideNode& from, int lane) {
    WideNode& to = nodes[count / tree_width];
    const int at = count++ % tree_width;
    if (at == 0) clear(to);
    for (int axis = 0; axis < 3; ++axis) {
      to.lo[axis][at] = from.lo[axis][lane];
      to.hi[axis][at] = from.hi[axis][lane];
    }
    to.child[at] = from.child[lane];
  }

 private:
  static void clear(WideNode& node) {
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < tree_width; ++i) {
        node.lo[axis][i] = infinite;
        node.hi[axis][i] = -infinite;
      }
    for (Child& c : node.child) c = {};
  }
};

/// Quarters a group of points, in their order, until nothing is in the shaft round their cones or
/// few are left, whose cones then walk from where the shaft's walk got to.
class GroupWalk {
 public:
  GroupWalk(const ConeTree::Data& data, const ConeGroup& group, const SearchLimit& limit,
            ConeCounts& counts)
      : data_(data), group_(group), limit_(limit), counts_(counts) {}

  void run() {
    Frontier all;
    WideNode root;
    for (int axis = 0; axis < 3; ++axis) {
      root.lo[axis][0] = (&data_.bounds.lo.x)[axis];
      root.hi[axis][0] = (&data_.bounds.hi.x)[axis];
    }
    root.child[0] = data_.root;
    all.add(root, 0);
    divide(0, group_.queries.size(), all);
  }

 private:
  static constexpr std::size_t few = 8;

  void divide(std::size_t first, std::size_t count, const Frontier& from) {
    const ConeShaft shaft(group_.queries.subspan(first, count), group_.ends.subspan(first, count),
                          data_.bounds);
    Frontier inner;
    narrow(from, shaft, inner);
    if (inner.count > 0 && count <= few) drop_leaves(first, count, shaft, inner);
    if (inner.count == 0) {
      for (std::size_t i = first; i < first + count; ++i)
        group_.clearances[i] = group_.queries[i].outer;
    } else if (count <= few) {
      for (std::size_t i = first; i < first + count; ++i) ask(i, inner);
    } else {
      const std::size_t part = (count + 3) / 4;
      for (std::size_t i = 0; i < count; i += part)
        divide(first + i, std::min(part, count - i), inner);
    }
  }

  /// What of `from` is in the shaft, and then its children, as long as there is room for them.
  void narrow(const Frontier& from, const ConeShaft& shaft, Frontier& out) {
    for (const WideNode& node : from.all()) {
      ++counts_.nodes;
      for (std::uint32_t hits = children_in(node, shaft); hits; hits &= hits - 1)
        out.add(node, std::countr_zero(hits));
    }
    Frontier deeper;
    while (open(out, shaft, deeper)) std::swap(out, deeper);
  }

  /// One level down; false if no child is a node or there is no room.
  bool open(const Frontier& from, const ConeShaft& shaft, Frontier& out) {
    out.count = 0;
    bool opened = false;
    for (int k = 0; k < from.count; ++k) {
      if (from.child(k).kind() != ChildKind::node) {
        if (out.is_full()) return false;
        out.add(from.nodes[k / tree_width], k % tree_width);
        continue;
      }
      const WideNode& node = data_.nodes[from.child(k).index()];
      opened = true;
      ++counts_.nodes;
      for (std::uint32_t hits = children_in(node, shaft); hits; hits &= hits - 1) {
        if (out.is_full()) return false;
        out.add(node, std::countr_zero(hits));
      }
    }
    return opened;
  }

  /// Leaves whose triangles no cone can touch, though it touches their boxes.
  void drop_leaves(std::size_t first, std::size_t count, const ConeShaft& shaft,
                   Frontier& frontier) {
    const ConeBundle bundle(group_.queries.subspan(first, count), shaft.center);
    if (!bundle.valid) return;
    Frontier kept;
    for (int k = 0; k < frontier.count; ++k) {
      const Child child = frontier.child(k);
      if (child.kind() == ChildKind::triangles) {
        ++counts_.leaves;
        if (!leaf_in(data_.triangles[child.index()], shaft, bundle)) continue;
      }
      kept.add(frontier.nodes[k / tree_width], k % tree_width);
    }
    std::swap(frontier, kept);
  }

  void ask(std::size_t i, const Frontier& from) {
    const ConeQuery& query = group_.queries[i];
    const LocalQuery local = local_query(data_, query);
    LeastSink sink(query.outer, limit_);
    Walk<LeastSink> walk(data_, local, sink, counts_);
    walk.run(from.all(), last_, query);
    group_.clearances[i] = sink.best();
    last_ = walk.found();
  }

  const ConeTree::Data& data_;
  const ConeGroup& group_;
  const SearchLimit& limit_;
  ConeCounts& counts_;
  Child last_;  ///< the leaf that decided for the point before
};

void walk_for_group(const ConeTree::Data& data, const ConeGroup& group, const SearchLimit& limit,
                    ConeCounts& counts) {
  GroupWalk(data, group, limit, counts).run();
}

}  // namespace penumbra::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
