// Triangles in a shaft. Included once per SIMD target.
#include "bake/raster_kernels.h"

// Per-target include guard.
#if defined(PENUMBRA_BAKE_COLLECT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_BAKE_COLLECT_INL_H_
#undef PENUMBRA_BAKE_COLLECT_INL_H_
#else
#define PENUMBRA_BAKE_COLLECT_INL_H_
#endif

#include <hwy/cache_control.h>

#include "bake/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::bake::HWY_NAMESPACE {

/// For each pattern of bits the lanes whose bits are set, in order, before the others. (The
/// library's CompressStore copies its table at every call.)
struct LaneOrder {
  HWY_ALIGN std::int32_t first_set[1u << lanes][lanes];

  LaneOrder() {
    for (std::uint32_t bits = 0; bits < 1u << lanes; ++bits) {
      std::size_t at = 0;
      for (const std::uint32_t wanted : {1u, 0u})
        for (std::uint32_t lane = 0; lane < lanes; ++lane)
          if ((bits >> lane & 1) == wanted) first_set[bits][at++] = static_cast<std::int32_t>(lane);
    }
  }
};
inline const LaneOrder& lane_order() {
  static const LaneOrder order;
  return order;
}

/// One walk through the tree.
class Collector {
 public:
  Collector(const Occluders& occluders, const Shaft& shaft, const OwnTriangles& own,
            int light_instance, TriangleList& out, std::vector<MaskedTriangle>& masked)
      : occluders_(occluders),
        shaft_(shaft),
        own_(own),
        light_instance_(static_cast<std::uint32_t>(light_instance)),
        out_(out),
        masked_(masked) {}

  void visit(std::size_t level, std::size_t index) {
    const BoxCluster& node = occluders_.levels()[level][index];
    const std::uint32_t inside = boxes_inside(node);
    if (level == 0)
      for (std::uint32_t bits = inside; bits != 0; bits &= bits - 1)
        prefetch(
            occluders_.clusters()[8 * index + static_cast<std::size_t>(std::countr_zero(bits))]);
    for (std::uint32_t bits = inside; bits != 0; bits &= bits - 1) {
      const std::size_t child = 8 * index + static_cast<std::size_t>(std::countr_zero(bits));
      if (level > 0)
        visit(level - 1, child);
      else
        take(occluders_.clusters()[child]);
    }
  }

 private:
  /// Clusters of a large scene come from memory, several lines each.
  HWY_INLINE static void prefetch(const TriangleCluster& cluster) {
    constexpr std::size_t line = 64;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&cluster);
    for (std::size_t at = 0; at < sizeof(TriangleCluster); at += line) hwy::Prefetch(bytes + at);
  }

  /// Bits of the boxes that reach into the shaft.
  HWY_INLINE std::uint32_t boxes_inside(const BoxCluster& node) const {
    std::uint32_t inside = 0;
    for (std::size_t i = 0; i < 8; i += lanes) {
      M in = hn::FirstN(
          D(), static_cast<std::size_t>(node.count) - std::min<std::size_t>(node.count, i));
      for (int k = 0; k < shaft_.count; ++k) {
        const Plane& p = shaft_.planes[k];
        const F x = load((p.normal.x > 0 ? node.hi : node.lo)[0] + i);
        const F y = load((p.normal.y > 0 ? node.hi : node.lo)[1] + i);
        const F z = load((p.normal.z > 0 ? node.hi : node.lo)[2] + i);
        in = hn::And(in, hn::Gt(affine(p.normal, p.offset, x, y, z), all(0)));
      }
      inside |= bits_of(in) << i;
    }
    return inside;
  }

  void take(const TriangleCluster& cluster) {
    const bool closed = sees_from_outside(cluster.closed_surfaces);
    out_.reserve(3 * TriangleCluster::size);
    for (std::size_t i = 0; i < 8; i += lanes) {
      F v[3][3];
      for (int c = 0; c < 3; ++c)
        for (int axis = 0; axis < 3; ++axis) v[c][axis] = load(cluster.corner[c][axis] + i);
      const std::size_t count = static_cast<std::size_t>(cluster.count);
      M in = hn::FirstN(D(), count - std::min(count, i));
      F lowest = all(0);
      for (int k = 0; k < shaft_.count; ++k) {
        const Plane& p = shaft_.planes[k];
        F at[3];
        for (int c = 0; c < 3; ++c) at[c] = affine(p.normal, p.offset, v[c][0], v[c][1], v[c][2]);
        in = hn::And(in, hn::Gt(hn::Max(at[0], hn::Max(at[1], at[2])), all(0)));
        if (k == 0) lowest = hn::Min(at[0], hn::Min(at[1], at[2]));
      }
      if (shaft_.light_epsilon > 0) in = hn::And(in, off_the_light(v));
      std::uint32_t bits = bits_of(in);
      if (bits == 0) continue;
      bits &= ~superfluous(cluster, i, v, closed);
      if (bits == 0) continue;
      bits = without_own(cluster, i, bits);
      // offset of plane 0 = −epsilon − n · origin, so that −2 epsilon here is −epsilon there.
      const float under = 2 * receiver_epsilon();
      const std::uint32_t crossing = bits_of(hn::Lt(lowest, all(-under))) & bits;
      if (cluster.masked) {
        take_one_by_one(cluster, i, bits, crossing);
        continue;
      }
      for (std::uint32_t b = crossing; b != 0; b &= b - 1)
        cut_off(cluster, i + static_cast<std::size_t>(std::countr_zero(b)));
      store(v, bits & ~crossing);
    }
  }

  /// True if the samples are outside of closed surfaces with these bounds.
  bool sees_from_outside(const Bounds& b) const {
    if (b.empty()) return false;
    const Bounds& s = shaft_.samples;
    return shaft_.at_infinity || s.lo.x > b.hi.x || s.lo.y > b.hi.y || s.lo.z > b.hi.z ||
           s.hi.x < b.lo.x || s.hi.y < b.lo.y || s.hi.z < b.lo.z;
  }

  /// Bits of the triangles that no segment from tile to sample needs: both are on one side of the
  /// triangle's plane, or, of closed surfaces if `closed`, all samples are on its inner side.
  HWY_INLINE std::uint32_t superfluous(const TriangleCluster& cluster, std::size_t i,
                                       const F v[3][3], bool closed) const {
    F u[3], w[3], n[3];
    for (int axis = 0; axis < 3; ++axis) {
      u[axis] = hn::Sub(v[1][axis], v[0][axis]);
      w[axis] = hn::Sub(v[2][axis], v[0][axis]);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const int b = (axis + 1) % 3, c = (axis + 2) % 3;
      n[axis] = hn::MulSub(u[b], w[c], hn::Mul(u[c], w[b]));
    }
    // Distances from the plane times twice the area, and how far they vary.
    const F size = hn::Sqrt(hn::MulAdd(n[0], n[0], hn::MulAdd(n[1], n[1], hn::Mul(n[2], n[2]))));
    const F of_samples = distance(n, v[0], shaft_.samples_middle, shaft_.at_infinity);
    const F of_tile = distance(n, v[0], shaft_.tile_middle, false);
    const F spread = hn::Mul(size, all(shaft_.samples_reach));
    const F extent = hn::MulAdd(
        size, all(shaft_.slack),
        hn::Add(hn::Abs(along(n, shaft_.tile_half_x)), hn::Abs(along(n, shaft_.tile_half_y))));
    const M beyond = hn::And(hn::Gt(of_samples, spread), hn::Gt(of_tile, extent));
    const M before = hn::And(hn::Lt(of_samples, hn::Neg(spread)), hn::Lt(of_tile, hn::Neg(extent)));
    M drop = hn::Or(beyond, before);
    if (closed) {
      const F side = load(cluster.outer_side + i);
      const F most = hn::MulAdd(side, of_samples, spread);
      drop = hn::Or(drop, hn::And(hn::Lt(most, all(0)), hn::Ne(side, all(0))));
    }
    return bits_of(drop);
  }

  HWY_INLINE static F along(const F n[3], const Vec3& p) {
    return hn::MulAdd(n[0], all(p.x), hn::MulAdd(n[1], all(p.y), hn::Mul(n[2], all(p.z))));
  }
  /// n · (p − from), or of a direction n · p.
  HWY_INLINE static F distance(const F n[3], const F from[3], const Vec3& p, bool is_direction) {
    if (is_direction) return along(n, p);
    return hn::MulAdd(
        n[0], hn::Sub(all(p.x), from[0]),
        hn::MulAdd(n[1], hn::Sub(all(p.y), from[1]), hn::Mul(n[2], hn::Sub(all(p.z), from[2]))));
  }

  HWY_INLINE M off_the_light(const F v[3][3]) const {
    const Plane& p = shaft_.light_plane;
    F most = all(0);
    for (int c = 0; c < 3; ++c)
      most = hn::Max(most, hn::Abs(affine(p.normal, p.offset, v[c][0], v[c][1], v[c][2])));
    return hn::Gt(most, all(shaft_.light_epsilon));
  }

  std::uint32_t without_own(const TriangleCluster& cluster, std::size_t first,
                            std::uint32_t bits) const {
    for (std::uint32_t b = bits; b != 0; b &= b - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(b));
      const std::uint32_t instance = cluster.instance[first + lane];
      if (instance == PrimitiveId::none) continue;
      if (instance == light_instance_ ||
          (instance == own_.instance() && own_.contain(cluster.triangle[first + lane])))
        bits &= ~(std::uint32_t{1} << lane);
    }
    return bits;
  }

  void store(const F v[3][3], std::uint32_t bits) {
    if (bits == 0) return;
    const auto order = hn::SetTableIndices(D(), &lane_order().first_set[bits][0]);
    for (int c = 0; c < 3; ++c)
      for (int axis = 0; axis < 3; ++axis)
        hn::StoreU(hn::TableLookupLanes(v[c][axis], order), D(), &out_.corner[c][axis][out_.count]);
    out_.count += static_cast<std::size_t>(std::popcount(bits));
  }

  static Vec3 corner_of(const TriangleCluster& cluster, std::size_t lane, int c) {
    return {cluster.corner[c][0][lane], cluster.corner[c][1][lane], cluster.corner[c][2][lane]};
  }

  void cut_off(const TriangleCluster& cluster, std::size_t lane) {
    ClipPolygon polygon{3, {}};
    for (int c = 0; c < 3; ++c) polygon.corners[c] = Vec3d(corner_of(cluster, lane, c));
    const Vec3d n(shaft_.planes[0].normal);
    const double offset = double(shaft_.planes[0].offset) + double(receiver_epsilon());
    clip(polygon, [&](const Vec3d& p) { return dot(n, p) + offset; });
    for (int c = 2; c < polygon.count; ++c)
      out_.add(Vec3(polygon.corners[0]), Vec3(polygon.corners[c - 1]), Vec3(polygon.corners[c]));
  }

  void take_one_by_one(const TriangleCluster& cluster, std::size_t first, std::uint32_t bits,
                       std::uint32_t crossing) {
    for (; bits != 0; bits &= bits - 1) {
      const int bit = std::countr_zero(bits);
      const std::size_t lane = first + static_cast<std::size_t>(bit);
      const Vec3 a = corner_of(cluster, lane, 0), b = corner_of(cluster, lane, 1),
                 c = corner_of(cluster, lane, 2);
      if (occluders_.mask(cluster.instance[lane]))
        masked_.push_back({{a, b, c}, cluster.instance[lane], cluster.triangle[lane]});
      else if (crossing >> bit & 1)
        cut_off(cluster, lane);
      else
        out_.add(a, b, c);
    }
  }

  float receiver_epsilon() const { return shaft_.receiver_epsilon; }

  const Occluders& occluders_;
  const Shaft& shaft_;
  const OwnTriangles& own_;
  std::uint32_t light_instance_;
  TriangleList& out_;
  std::vector<MaskedTriangle>& masked_;
};

void collect_in(const Occluders& occluders, const Shaft& shaft, const OwnTriangles& own,
                int light_instance, TriangleList& out, std::vector<MaskedTriangle>& masked) {
  if (occluders.levels().empty()) return;
  Collector(occluders, shaft, own, light_instance, out, masked)
      .visit(occluders.levels().size() - 1, 0);
}

}  // namespace penumbra::bake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
