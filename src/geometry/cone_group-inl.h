// The walks of many neighbouring points together. Included once per SIMD target.
#if defined(PENUMBRA_CONE_GROUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_CONE_GROUP_INL_H
#undef PENUMBRA_CONE_GROUP_INL_H
#else
#define PENUMBRA_CONE_GROUP_INL_H
#endif

#include <algorithm>
#include <span>

#include "geometry/cone_shafts-inl.h"
#include "geometry/cone_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::HWY_NAMESPACE {

/// Children of the tree, eight side by side, that a shaft touches: where the walks of its points
/// begin.
class Frontier {
 public:
  static constexpr int most = 2 * tree_width;

  int count() const { return count_; }
  std::span<const WideNode> all() const {
    return {nodes_, static_cast<std::size_t>((count_ + tree_width - 1) / tree_width)};
  }
  Child child(int i) const { return nodes_[i / tree_width].child[i % tree_width]; }

  void clear() { count_ = 0; }
  /// Once all are added, close() it.
  HWY_INLINE void add(const WideNode& from, int lane) {
    WideNode& to = nodes_[count_ / tree_width];
    const int at = count_++ % tree_width;
    for (int axis = 0; axis < 3; ++axis) {
      to.lo[axis][at] = from.lo[axis][lane];
      to.hi[axis][at] = from.hi[axis][lane];
    }
    to.child[at] = from.child[lane];
  }
  HWY_INLINE void add(const Frontier& from, int i) {
    add(from.nodes_[i / tree_width], i % tree_width);
  }
  /// The lanes that are left hold nothing.
  void close() {
    if (count_ % tree_width == 0) return;
    WideNode& last = nodes_[count_ / tree_width];
    for (int i = count_ % tree_width; i < tree_width; ++i) {
      for (int axis = 0; axis < 3; ++axis)
        last.lo[axis][i] = infinite, last.hi[axis][i] = -infinite;
      last.child[i] = {};
    }
  }

 private:
  WideNode nodes_[most / tree_width];
  int count_ = 0;
};

/// Quarters a batch of points, in their order, until nothing is in the shaft round their cones or
/// four are left, whose cones then walk from where the shaft's walk got to.
class GroupWalk {
 public:
  GroupWalk(const ConeTree::Data& data, const ConeBatch& queries, std::span<float> clearances,
            const SearchLimit& limit, ConeCounts& counts)
      : data_(data), queries_(queries), clearances_(clearances), limit_(limit), counts_(counts) {}

  void run() {
    WideNode root;
    for (int axis = 0; axis < 3; ++axis) {
      root.lo[axis][0] = (&data_.bounds.lo.x)[axis];
      root.hi[axis][0] = (&data_.bounds.hi.x)[axis];
    }
    root.child[0] = data_.root;
    Frontier all;
    all.add(root, 0), all.close();
    shafts_.build(queries_, data_.bounds);
    divide(shafts_.top(), 0, all);
  }

 private:
  void divide(int level, std::size_t i, const Frontier& from) {
    const std::size_t step = std::size_t{4} << 2 * level, first = i * step;
    const std::size_t last = std::min(first + step, queries_.size());
    const ConeShaft shaft = shafts_.shaft(level, i);
    Frontier one, other;
    Frontier* inner = narrow(from, shaft, &one, &other);
    if (inner->count() > 0 && level == 0) drop_leaves(first, last - first, shaft, *inner);
    if (inner->count() == 0) {
      const float* outer = queries_.column(ConeBatch::outer);
      std::copy(outer + first, outer + last, clearances_.begin() + first);
    } else if (level == 0) {
      for (std::size_t k = first; k < last; ++k) ask(k, *inner);
    } else {
      const std::size_t end = std::min(4 * i + 4, shafts_.size(level - 1));
      for (std::size_t k = 4 * i; k < end; ++k) divide(level - 1, k, *inner);
    }
  }

  /// What of `from` is in the shaft, and then its children, as long as there is room for them: in
  /// one of the two.
  Frontier* narrow(const Frontier& from, const ConeShaft& shaft, Frontier* out, Frontier* spare) {
    for (const WideNode& node : from.all()) {
      ++counts_.nodes;
      add(*out, node, children_in(node, shaft));
    }
    for (bool goes_on = true; goes_on; std::swap(out, spare)) goes_on = open(*out, shaft, *spare);
    out->close();
    return out;
  }

  /// But for the light that the queries are for.
  HWY_INLINE void add(Frontier& out, const WideNode& node, std::uint32_t hits) const {
    for (; hits; hits &= hits - 1) {
      const int lane = std::countr_zero(hits);
      const Child child = node.child[lane];
      if (queries_.excluded_instance() >= 0 && child.kind() == ChildKind::placement &&
          static_cast<int>(data_.placements[child.index()].instance) ==
              queries_.excluded_instance())
        continue;
      out.add(node, lane);
    }
  }

  /// One level down, as far as there is room; false if nothing is left to open.
  bool open(const Frontier& from, const ConeShaft& shaft, Frontier& out) {
    out.clear();
    bool opened = false, full = false;
    for (int k = 0; k < from.count(); ++k) {
      if (full || from.child(k).kind() != ChildKind::node) {
        out.add(from, k);
        continue;
      }
      const WideNode& node = data_.nodes[from.child(k).index()];
      ++counts_.nodes;
      const std::uint32_t hits = children_in(node, shaft);
      full = out.count() + std::popcount(hits) + from.count() - k - 1 > Frontier::most;
      if (full) {
        out.add(from, k);
        continue;
      }
      opened = true;
      add(out, node, hits);
    }
    return opened && !full;
  }

  /// Leaves whose triangles no cone can touch, though it touches their boxes.
  void drop_leaves(std::size_t first, std::size_t count, const ConeShaft& shaft,
                   Frontier& frontier) {
    const ConeBundle bundle(queries_, first, count, shaft.center);
    if (!bundle.valid) return;
    const int all = frontier.count();
    frontier.clear();
    for (int k = 0; k < all; ++k) {
      const Child child = frontier.child(k);
      if (child.kind() == ChildKind::triangles) {
        ++counts_.leaves;
        if (!leaf_in(data_.triangles[child.index()], shaft, bundle)) continue;
      }
      frontier.add(frontier, k);
    }
    frontier.close();
  }

  void ask(std::size_t i, const Frontier& from) {
    const ConeQuery query = queries_.query(i);
    const LocalQuery local(query, data_.bounds);
    LeastSink sink(query.outer, limit_);
    Walk<LeastSink> walk(data_, local, sink, counts_);
    walk.run(from.all(), last_, query);
    clearances_[i] = sink.best();
    last_ = walk.found();
  }

  const ConeTree::Data& data_;
  const ConeBatch& queries_;
  std::span<float> clearances_;
  const SearchLimit& limit_;
  ConeCounts& counts_;
  ConeShafts& shafts_ = kept_shafts();
  Child last_;  ///< the leaf that decided for the point before

  static ConeShafts& kept_shafts() {
    thread_local ConeShafts shafts;
    return shafts;
  }
};

void walk_for_group(const ConeTree::Data& data, const ConeBatch& queries,
                    std::span<float> clearances, const SearchLimit& limit, ConeCounts& counts) {
  GroupWalk(data, queries, clearances, limit, counts).run();
}

}  // namespace penumbra::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
