// Short names for vectors of up to eight floats. Included once per SIMD target.
#include <cstddef>
#include <cstdint>

#include "base/vec.h"

// Per-target include guard.
#if defined(PENUMBRA_BAKE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_BAKE_LANES_INL_H_
#undef PENUMBRA_BAKE_LANES_INL_H_
#else
#define PENUMBRA_BAKE_LANES_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace penumbra::bake::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 8>;
using DI = hn::RebindToSigned<D>;
using F = hn::Vec<D>;
using I = hn::Vec<DI>;
using M = hn::Mask<D>;
HWY_INLINE constexpr std::size_t lane_count() { return hn::MaxLanes(D()); }
inline constexpr std::size_t lanes = lane_count();

HWY_INLINE F all(float x) { return hn::Set(D(), x); }
HWY_INLINE F load(const float* p) { return hn::LoadU(D(), p); }

/// n · (x, y, z) + c
HWY_INLINE F affine(const Vec3& n, float c, F x, F y, F z) {
  return hn::MulAdd(all(n.x), x, hn::MulAdd(all(n.y), y, hn::MulAdd(all(n.z), z, all(c))));
}

HWY_INLINE std::uint32_t bits_of(M mask) {
  HWY_ALIGN std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(D(), mask, bytes);
  return bytes[0];
}

}  // namespace penumbra::bake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
