// The walk through the tree. Included once per SIMD target.
#if defined(PENUMBRA_CONE_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_CONE_WALK_INL_H
#undef PENUMBRA_CONE_WALK_INL_H
#else
#define PENUMBRA_CONE_WALK_INL_H
#endif

#include <algorithm>
#include <bit>
#include <span>

#include "geometry/cone_leaves-inl.h"
#include "geometry/cone_sinks.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::HWY_NAMESPACE {

/// The tree has at most 64 levels (the builder's limit and one), and each leaves seven behind.
constexpr int stack_size = 512;

template <class Sink>
class Walk {
 public:
  Walk(const ConeTree::Data& data, const LocalQuery& query, Sink& sink, ConeCounts& counts,
       std::uint32_t placed_instance = 0xffffffffu)
      : data_(data), q_(query), sink_(sink), counts_(counts), placed_(placed_instance) {}

  void run(Child root, const ConeQuery& world) {
    slabs_ = ConeSlabs(q_, sink_.limit());
    push(root, 0);
    run(world);
  }

  /// From where a group's walk got to: the children in `frontier`. `hint`: a leaf that is likely to
  /// matter, or none.
  void run(std::span<const WideNode> frontier, Child hint, const ConeQuery& world) {
    if (hint.kind() != ChildKind::none && visit(hint, world)) found_ = hint;
    if (sink_.done()) return;
    slabs_ = ConeSlabs(q_, sink_.limit());
    for (const WideNode& node : frontier) open(node);
    std::sort(stack_, stack_ + size_,
              [](const Entry& a, const Entry& b) { return a.least > b.least; });
    run(world);
  }

  /// The leaf that gave the sink its best answer; none if nothing did.
  Child found() const { return found_; }

 private:
  struct Entry {
    std::uint32_t child;  // bits of a Child, so that the stack costs nothing to make
    float least;
  };

  void run(const ConeQuery& world) {
    while (size_ > 0 && !sink_.done()) {
      const Entry entry = stack_[--size_];
      if (!(entry.least < sink_.limit())) continue;
      if (!visit({entry.child}, world)) continue;
      found_ = {entry.child};
      slabs_ = ConeSlabs(q_, sink_.limit());
    }
  }

  void push(Child child, float least) { stack_[size_++] = {child.bits, least}; }

  // True if the cone became narrower.
  bool visit(Child child, const ConeQuery& world) {
    switch (child.kind()) {
      case ChildKind::node:
        return open(data_.nodes[child.index()]);
      case ChildKind::triangles:
        return look(data_.triangles[child.index()]);
      case ChildKind::spheres:
        return look(data_.spheres[child.index()]);
      case ChildKind::placement:
        return enter(data_.placements[child.index()], world);
      case ChildKind::cut_out:
        return look(data_.cut_outs[child.index()], world);
      case ChildKind::none:
        break;
    }
    return false;
  }

  // Children go on the stack so that the one nearest to the axis is on top.
  HWY_INLINE bool open(const WideNode& node) {
    ++counts_.nodes;
    ChildTest test;
    test_children(node, q_, slabs_, sink_.limit(), test);
    int found[tree_width], count = 0;
    for (std::uint32_t hits = test.hits; hits; hits &= hits - 1) {
      const int i = std::countr_zero(hits);
      int at = count++;
      for (; at > 0 && test.least[found[at - 1]] < test.least[i]; --at) found[at] = found[at - 1];
      found[at] = i;
    }
    for (int i = 0; i < count; ++i) push(node.child[found[i]], test.least[found[i]]);
    return false;
  }

  HWY_INLINE bool look(const TriangleLeaf& leaf) {
    ++counts_.leaves;
    LeafClearance found;
    triangle_lanes(leaf, q_, sink_.limit(), found);
    if constexpr (Sink::by_object) {
      for (int i = 0; i < tree_width; ++i)
        if (found.lane[i] < sink_.limit()) sink_.offer(found.lane[i], object_of(leaf.id[i]));
      return false;
    } else {
      return sink_.offer(least_of(found));
    }
  }

  HWY_INLINE bool look(const SphereLeaf& leaf) {
    ++counts_.leaves;
    LeafClearance found;
    sphere_lanes(leaf, q_, sink_.limit(), found);
    if constexpr (Sink::by_object) {
      for (int i = 0; i < tree_width; ++i) sink_.offer(found.lane[i], leaf.object[i]);
      return false;
    } else {
      return sink_.offer(least_of(found));
    }
  }

  HWY_NOINLINE bool look(const CutOut& cut, const ConeQuery& world) {
    if (is_excluded(cut.instance, world)) return false;
    ++counts_.leaves;
    const float clearance = cut_out_clearance(data_, cut, q_);
    if constexpr (Sink::by_object)
      return sink_.offer(clearance, data_.scene->instances[cut.instance].object);
    else
      return sink_.offer(clearance);
  }

  static bool is_excluded(std::uint32_t instance, const ConeQuery& world) {
    return world.excluded_instance >= 0 &&
           instance == static_cast<std::uint32_t>(world.excluded_instance);
  }

  HWY_NOINLINE bool enter(const Placement& placed, const ConeQuery& world) {
    if (is_excluded(placed.instance, world)) return false;
    ConeQuery inner = world;
    const Affine& m = placed.mesh_from_world;
    const float scale = placed.mesh_scale;
    inner.origin = m.point(world.origin);
    const auto turned = [&](const Vec3& v) { return Vec3(normalize(m.vector(Vec3d(v)))); };
    inner.direction = turned(world.direction);
    inner.horizon = turned(world.horizon);
    inner.distance *= scale, inner.epsilon *= scale;
    if (world.has_plane) inner.plane_normal = turned(world.plane_normal);
    inner.plane_distance *= scale, inner.plane_epsilon *= scale;
    Bounds bounds = bounds_of_root(placed.root);
    const LocalQuery local(inner, bounds);
    const float before = sink_.limit();
    Walk(data_, local, sink_, counts_, placed.instance).run(placed.root, inner);
    return sink_.limit() < before;
  }

  Bounds bounds_of_root(Child root) const {
    Bounds bounds;
    if (root.kind() == ChildKind::triangles) {
      const TriangleLeaf& leaf = data_.triangles[root.index()];
      for (const auto& p : leaf.position)
        for (int i = 0; i < tree_width; ++i) bounds.grow(Vec3{p[0][i], p[1][i], p[2][i]});
    } else {
      const WideNode& node = data_.nodes[root.index()];
      for (int i = 0; i < tree_width; ++i) {
        if (node.lo[0][i] > node.hi[0][i]) continue;
        bounds.grow(Vec3{node.lo[0][i], node.lo[1][i], node.lo[2][i]});
        bounds.grow(Vec3{node.hi[0][i], node.hi[1][i], node.hi[2][i]});
      }
    }
    return bounds;
  }

  std::uint32_t object_of(std::uint32_t id) const {
    const std::uint32_t instance = placed_ != 0xffffffffu ? placed_ : data_.instance_of(id);
    return data_.scene->instances[instance].object;
  }

  const ConeTree::Data& data_;
  const LocalQuery& q_;
  Sink& sink_;
  ConeCounts& counts_;
  ConeSlabs slabs_;
  std::uint32_t placed_;
  Child found_;
  Entry stack_[stack_size];
  int size_ = 0;
};

template <class Sink>
void walk(const ConeTree::Data& data, const ConeQuery& query, Sink& sink, ConeCounts& counts) {
  const LocalQuery local(query, data.bounds);
  Walk<Sink>(data, local, sink, counts).run(data.root, query);
}

void walk_for_least(const ConeTree::Data& data, const ConeQuery& query, LeastSink& sink,
                    ConeCounts& counts) {
  walk(data, query, sink, counts);
}
void walk_for_objects(const ConeTree::Data& data, const ConeQuery& query, ObjectSink& sink,
                      ConeCounts& counts) {
  walk(data, query, sink, counts);
}

}  // namespace penumbra::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
