// Eight boxes, triangles or spheres against one cone. Included once per SIMD target.
#if defined(PENUMBRA_CONE_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_CONE_SIMD_INL_H
#undef PENUMBRA_CONE_SIMD_INL_H
#else
#define PENUMBRA_CONE_SIMD_INL_H
#endif

#include <hwy/highway.h>

#include "geometry/cone_shaft.h"
#include "geometry/cone_tree_data.h"
#include "geometry/local_query.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, tree_width>;
using Floats = hn::Vec<Lanes>;
using Bools = hn::Mask<Lanes>;

constexpr float infinite = std::numeric_limits<float>::infinity();

HWY_INLINE Floats all(float x) { return hn::Set(Lanes(), x); }

/// A vector of eight lanes' points.
struct Point {
  Floats x, y, z;
};

HWY_INLINE Floats dot(const Vec3& a, const Point& b) {
  return hn::MulAdd(all(a.x), b.x, hn::MulAdd(all(a.y), b.y, hn::Mul(all(a.z), b.z)));
}
HWY_INLINE Point lerp(const Point& a, const Point& b, Floats s) {
  return {hn::MulAdd(s, hn::Sub(b.x, a.x), a.x), hn::MulAdd(s, hn::Sub(b.y, a.y), a.y),
          hn::MulAdd(s, hn::Sub(b.z, a.z), a.z)};
}
HWY_INLINE Point select(Bools m, const Point& yes, const Point& no) {
  return {hn::IfThenElse(m, yes.x, no.x), hn::IfThenElse(m, yes.y, no.y),
          hn::IfThenElse(m, yes.z, no.z)};
}
HWY_INLINE std::uint32_t bits_of(Bools m) {
  HWY_ALIGN std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Lanes(), m, bytes);
  return bytes[0];
}

/// What a node's children promise.
struct ChildTest {
  std::uint32_t hits = 0;             ///< a bit per child that the cone may touch
  HWY_ALIGN float least[tree_width];  ///< no point of the child has a smaller clearance; negative
                                      ///< where its bounding sphere reaches over the axis
};

/// Slabs: ConeSlabs or ConeShaft.
template <class Slabs>
HWY_INLINE void slab(Floats lo, Floats hi, const Slabs& slabs, int axis, Floats& near,
                     Floats& far) {
  const Floats a = hn::Mul(lo, all(slabs.inv_lo[axis])), b = hn::Mul(hi, all(slabs.inv_hi[axis]));
  if (slabs.lo_is_near[axis])
    near = hn::Max(near, a);
  else
    far = hn::Min(far, a);
  if (slabs.hi_is_far[axis])
    far = hn::Min(far, b);
  else
    near = hn::Max(near, b);
}

/// near ≤ far, with a few roundings on either side (Ize 2013, Robust BVH Ray Traversal).
HWY_INLINE Bools overlap(Floats near, Floats far) {
  return hn::Le(hn::Mul(near, all(1 - 0x1p-21f)), hn::Mul(far, all(1 + 0x1p-21f)));
}

HWY_INLINE void test_children(const WideNode& node, const LocalQuery& q, const ConeSlabs& slabs,
                              float limit, ChildTest& test) {
  const Lanes d;
  const float* origin = &q.origin.x;
  const float* horizon = &q.horizon.x;
  test.hits = 0;
  for (std::size_t first = 0; first < tree_width; first += hn::Lanes(d)) {
    Floats near = hn::Zero(d), far = all(q.reach), height = hn::Zero(d);
    Floats middle[3], size2 = hn::Zero(d);
    for (int axis = 0; axis < 3; ++axis) {
      const Floats o = all(origin[axis]);
      const Floats lo = hn::Sub(hn::Load(d, node.lo[axis] + first), o);
      const Floats hi = hn::Sub(hn::Load(d, node.hi[axis] + first), o);
      slab(lo, hi, slabs, axis, near, far);
      height = hn::MulAdd(all(horizon[axis]), horizon[axis] > 0 ? hi : lo, height);
      middle[axis] = hn::Mul(hn::Add(lo, hi), all(0.5f));
      const Floats half = hn::Mul(hn::Sub(hi, lo), all(0.5f));
      size2 = hn::MulAdd(half, half, size2);
    }
    const Bools met = overlap(near, far);
    const Bools above = hn::Gt(height, all(q.epsilon));

    const Point c{middle[0], middle[1], middle[2]};
    const Floats x = dot(q.ray.u, c), y = dot(q.ray.v, c), z = dot(q.ray.w, c);
    const Floats r = hn::Sqrt(size2), away = hn::Sqrt(hn::MulAdd(x, x, hn::Mul(y, y)));
    const Floats reach = hn::Max(hn::Add(z, r), all(1e-30f));
    const Floats least = hn::Div(hn::Sub(away, r), reach);
    hn::Store(least, d, test.least + first);
    const Bools near_enough = hn::Lt(least, all(limit));
    test.hits |= bits_of(hn::And(hn::And(met, above), near_enough)) << first;
  }
}

/// A bit for every child that some cone of the shaft may touch.
HWY_INLINE std::uint32_t children_in(const WideNode& node, const ConeShaft& shaft) {
  const Lanes d;
  std::uint32_t hits = 0;
  const float *from_lo = &shaft.from_lo.x, *from_hi = &shaft.from_hi.x, *center = &shaft.center.x;
  const float *normal_lo = &shaft.normal_lo.x, *normal_hi = &shaft.normal_hi.x;
  for (std::size_t first = 0; first < tree_width; first += hn::Lanes(d)) {
    Floats near = hn::Zero(d), far = all(shaft.reach), height = all(shaft.lift);
    for (int axis = 0; axis < 3; ++axis) {
      const Floats lo = hn::Load(d, node.lo[axis] + first);
      const Floats hi = hn::Load(d, node.hi[axis] + first);
      slab(hn::Sub(lo, all(from_hi[axis])), hn::Sub(hi, all(from_lo[axis])), shaft, axis, near,
           far);
      const Floats below = hn::Sub(lo, all(center[axis])), above = hn::Sub(hi, all(center[axis]));
      const Floats a = all(normal_lo[axis]), b = all(normal_hi[axis]);
      height = hn::Add(height, hn::Max(hn::Max(hn::Mul(a, below), hn::Mul(a, above)),
                                       hn::Max(hn::Mul(b, below), hn::Mul(b, above))));
    }
    const Bools high = hn::Gt(height, all(shaft.epsilon));
    hits |= bits_of(hn::And(overlap(near, far), high)) << first;
  }
  return hits;
}

/// Squared distance from the origin to segments in the plane at unit distance, ends given before
/// division; the SIMD twin of parker::detail::segment_clearance without its ends. Squares, for
/// roots cost as much as the rest.
HWY_INLINE Floats side_clearance2(const Point& a, const Point& b) {
  const Floats nx = hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y));
  const Floats ny = hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z));
  const Floats nz = hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x));
  const Floats along_a = hn::MulSub(a.y, nx, hn::Mul(a.x, ny));
  const Floats along_b = hn::MulSub(b.y, nx, hn::Mul(b.x, ny));
  const Floats across = hn::MulAdd(nx, nx, hn::Mul(ny, ny));
  const Bools between =
      hn::And(hn::Xor(hn::Lt(along_a, hn::Zero(Lanes())), hn::Lt(along_b, hn::Zero(Lanes()))),
              hn::Gt(across, hn::Zero(Lanes())));
  return hn::IfThenElse(between, hn::Div(hn::Mul(nz, nz), across), all(infinite));
}

HWY_INLINE Floats end_clearance2(const Point& a) {
  const Floats away2 = hn::MulAdd(a.x, a.x, hn::Mul(a.y, a.y));
  return hn::IfThenElse(hn::Gt(a.z, hn::Zero(Lanes())), hn::Div(away2, hn::Mul(a.z, a.z)),
                        all(infinite));
}

}  // namespace penumbra::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
