#include "geometry/wide_builder.h"

#include <algorithm>
#include <limits>
#include <new>
#include <numeric>

#include "base/error.h"
#include "geometry/embree_shim.h"

namespace penumbra {
namespace {

constexpr int max_leaf = tree_width;

// What Embree's builder makes; allocated in its arena, gone with it.
struct Built {
  bool leaf;
};
struct BuiltNode : Built {
  int count = 0;
  Built* child[tree_width] = {};
  RTCBounds bounds[tree_width] = {};
};
struct BuiltLeaf : Built {
  int count = 0;
  RTCBounds bounds[max_leaf] = {};
  std::uint32_t kind[max_leaf] = {};
  std::uint32_t index[max_leaf] = {};
};

void* create_node(RTCThreadLocalAllocator allocator, unsigned /*children*/, void* /*user*/) {
  return new (rtcThreadLocalAlloc(allocator, sizeof(BuiltNode), 16)) BuiltNode{{false}};
}

void set_children(void* node, void** children, unsigned count, void* /*user*/) {
  auto& built = *static_cast<BuiltNode*>(node);
  built.count = static_cast<int>(count);
  for (unsigned i = 0; i < count; ++i) built.child[i] = static_cast<Built*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void* /*user*/) {
  auto& built = *static_cast<BuiltNode*>(node);
  for (unsigned i = 0; i < count; ++i) built.bounds[i] = *bounds[i];
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                  std::size_t count, void* /*user*/) {
  auto* leaf = new (rtcThreadLocalAlloc(allocator, sizeof(BuiltLeaf), 16)) BuiltLeaf{{true}};
  leaf->count = static_cast<int>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const RTCBuildPrimitive& p = primitives[i];
    leaf->bounds[i] = {p.lower_x, p.lower_y, p.lower_z, 0, p.upper_x, p.upper_y, p.upper_z, 0};
    leaf->kind[i] = p.geomID;
    leaf->index[i] = p.primID;
  }
  return leaf;
}

std::vector<RTCBuildPrimitive> embree_primitives(const std::vector<BuildPrimitive>& primitives) {
  std::vector<RTCBuildPrimitive> out(primitives.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const BuildPrimitive& p = primitives[i];
    const Vec3 &lo = p.bounds.lo, &hi = p.bounds.hi;
    out[i] = {lo.x, lo.y, lo.z, static_cast<unsigned>(p.kind), hi.x, hi.y, hi.z, p.index};
  }
  return out;
}

RTCBuildArguments arguments(RTCBVH bvh, std::vector<RTCBuildPrimitive>& primitives) {
  RTCBuildArguments args = rtcDefaultBuildArguments();
  args.byteSize = sizeof args;
  args.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
  args.maxBranchingFactor = tree_width;
  args.maxDepth = 60;
  args.sahBlockSize = max_leaf;  // eight triangles cost what one costs
  args.minLeafSize = 8;
  args.maxLeafSize = max_leaf;
  args.traversalCost = 1;
  args.intersectionCost = 1.5f;  // a leaf of triangles takes about this many node visits
  args.bvh = bvh;
  args.primitives = primitives.data();
  args.primitiveCount = primitives.size();
  args.primitiveArrayCapacity = primitives.size();
  args.createNode = create_node;
  args.setNodeChildren = set_children;
  args.setNodeBounds = set_bounds;
  args.createLeaf = create_leaf;
  return args;
}

WideNode empty_node() {
  WideNode node{};
  constexpr float big = std::numeric_limits<float>::max();
  for (int axis = 0; axis < 3; ++axis) {
    std::fill_n(node.lo[axis], tree_width, big);
    std::fill_n(node.hi[axis], tree_width, -big);
  }
  return node;
}

void set_box(WideNode& node, int slot, const RTCBounds& b) {
  const float lo[] = {b.lower_x, b.lower_y, b.lower_z}, hi[] = {b.upper_x, b.upper_y, b.upper_z};
  for (int axis = 0; axis < 3; ++axis) {
    node.lo[axis][slot] = lo[axis];
    node.hi[axis][slot] = hi[axis];
  }
}

RTCBounds joined(const RTCBounds& a, const RTCBounds& b) {
  return {std::min(a.lower_x, b.lower_x), std::min(a.lower_y, b.lower_y),
          std::min(a.lower_z, b.lower_z), 0,
          std::max(a.upper_x, b.upper_x), std::max(a.upper_y, b.upper_y),
          std::max(a.upper_z, b.upper_z), 0};
}

class Flattener {
 public:
  Flattener(HugeVector<WideNode>& nodes, const PackLeaf& pack) : nodes_(nodes), pack_(pack) {}

  // Depth is bounded by the builder's maxDepth.
  Child flatten(const Built* built) {
    if (built->leaf) return flatten_leaf(*static_cast<const BuiltLeaf*>(built));
    const auto& source = *static_cast<const BuiltNode*>(built);
    const std::size_t index = nodes_.size();
    nodes_.push_back(empty_node());
    for (int i = 0; i < source.count; ++i) {
      const Child child = flatten(source.child[i]);
      set_box(nodes_[index], i, source.bounds[i]);
      nodes_[index].child[i] = child;
    }
    return Child::of(ChildKind::node, index);
  }

 private:
  struct Group {
    Child child;
    RTCBounds bounds;
  };

  // A leaf of several kinds, or of several placements, becomes a small node.
  Child flatten_leaf(const BuiltLeaf& leaf) {
    std::vector<int> order(static_cast<std::size_t>(leaf.count));
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return std::pair(leaf.kind[a], leaf.index[a]) < std::pair(leaf.kind[b], leaf.index[b]);
    });
    std::vector<Group> groups;
    for (int first = 0, last = 0; first < leaf.count; first = last) {
      last = group_end(leaf, order, first);
      groups.push_back(pack_group(leaf, order, first, last));
    }
    if (groups.size() == 1) return groups.front().child;
    const std::size_t index = nodes_.size();
    nodes_.push_back(empty_node());
    for (std::size_t i = 0; i < groups.size(); ++i) {
      set_box(nodes_[index], static_cast<int>(i), groups[i].bounds);
      nodes_[index].child[i] = groups[i].child;
    }
    return Child::of(ChildKind::node, index);
  }

  static int group_end(const BuiltLeaf& leaf, const std::vector<int>& order, int first) {
    const auto kind = leaf.kind[order[static_cast<std::size_t>(first)]];
    const bool packs = kind == static_cast<unsigned>(ChildKind::triangles) ||
                       kind == static_cast<unsigned>(ChildKind::spheres);
    int last = first + 1;
    while (packs && last < leaf.count && leaf.kind[order[static_cast<std::size_t>(last)]] == kind)
      ++last;
    return last;
  }

  Group pack_group(const BuiltLeaf& leaf, const std::vector<int>& order, int first,
                   int last) const {
    std::uint32_t indices[max_leaf];
    const int head = order[static_cast<std::size_t>(first)];
    Group group{{}, leaf.bounds[head]};
    for (int i = first; i < last; ++i) {
      const int at = order[static_cast<std::size_t>(i)];
      indices[i - first] = leaf.index[at];
      group.bounds = joined(group.bounds, leaf.bounds[at]);
    }
    group.child = pack_(static_cast<ChildKind>(leaf.kind[head]), indices, last - first);
    return group;
  }

  HugeVector<WideNode>& nodes_;
  const PackLeaf& pack_;
};

}  // namespace

Child build_wide_tree(const std::vector<BuildPrimitive>& primitives, HugeVector<WideNode>& nodes,
                      const PackLeaf& pack) {
  if (primitives.empty()) return {};
  std::vector<RTCBuildPrimitive> input = embree_primitives(primitives);
  RTCDevice device = rtcNewDevice(nullptr);
  RTCBVH bvh = rtcNewBVH(device);
  const RTCBuildArguments args = arguments(bvh, input);
  const auto* root = static_cast<const Built*>(rtcBuildBVH(&args));
  Child child;
  if (root) child = Flattener(nodes, pack).flatten(root);
  rtcReleaseBVH(bvh);
  rtcReleaseDevice(device);
  if (!root) throw WorkError("not enough memory for the shadow tree", "use a smaller scene");
  return child;
}

}  // namespace penumbra
