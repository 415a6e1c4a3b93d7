// Sixteen floats as one number, and points of them. Included once per SIMD target.
#if defined(PENUMBRA_SDF_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_SDF_LANES_INL_H
#undef PENUMBRA_SDF_LANES_INL_H
#else
#define PENUMBRA_SDF_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace penumbra::sdf::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;
using VM = hn::Mask<D>;
inline constexpr int lanes = 16;
inline constexpr int vector_lanes = static_cast<int>(hn::MaxLanes(D()));
inline constexpr int vectors = lanes / vector_lanes;

struct M {
  VM v[vectors];
};
struct F {
  V v[vectors];
  F() = default;
  HWY_INLINE F(float x) {
    for (int i = 0; i < vectors; ++i) v[i] = hn::Set(D(), x);
  }
};

#define PENUMBRA_LANEWISE(expression)                      \
  F r;                                                     \
  for (int i = 0; i < vectors; ++i) r.v[i] = (expression); \
  return r
#define PENUMBRA_MASKWISE(expression)                      \
  M r;                                                     \
  for (int i = 0; i < vectors; ++i) r.v[i] = (expression); \
  return r

HWY_INLINE F load(const float* p) { PENUMBRA_LANEWISE(hn::LoadU(D(), p + i * vector_lanes)); }
HWY_INLINE void store(const F& a, float* p) {
  for (int i = 0; i < vectors; ++i) hn::StoreU(a.v[i], D(), p + i * vector_lanes);
}
HWY_INLINE F operator+(const F& a, const F& b) { PENUMBRA_LANEWISE(hn::Add(a.v[i], b.v[i])); }
HWY_INLINE F operator-(const F& a, const F& b) { PENUMBRA_LANEWISE(hn::Sub(a.v[i], b.v[i])); }
HWY_INLINE F operator*(const F& a, const F& b) { PENUMBRA_LANEWISE(hn::Mul(a.v[i], b.v[i])); }
HWY_INLINE F operator/(const F& a, const F& b) { PENUMBRA_LANEWISE(hn::Div(a.v[i], b.v[i])); }
HWY_INLINE F operator-(const F& a) { PENUMBRA_LANEWISE(hn::Neg(a.v[i])); }
/// a b + c
HWY_INLINE F mad(const F& a, const F& b, const F& c) {
  PENUMBRA_LANEWISE(hn::MulAdd(a.v[i], b.v[i], c.v[i]));
}
/// c − a b
HWY_INLINE F nmad(const F& a, const F& b, const F& c) {
  PENUMBRA_LANEWISE(hn::NegMulAdd(a.v[i], b.v[i], c.v[i]));
}
HWY_INLINE F min(const F& a, const F& b) { PENUMBRA_LANEWISE(hn::Min(a.v[i], b.v[i])); }
HWY_INLINE F max(const F& a, const F& b) { PENUMBRA_LANEWISE(hn::Max(a.v[i], b.v[i])); }
HWY_INLINE F abs(const F& a) { PENUMBRA_LANEWISE(hn::Abs(a.v[i])); }
HWY_INLINE F sqrt(const F& a) { PENUMBRA_LANEWISE(hn::Sqrt(a.v[i])); }
HWY_INLINE F round(const F& a) { PENUMBRA_LANEWISE(hn::Round(a.v[i])); }
HWY_INLINE F floor(const F& a) { PENUMBRA_LANEWISE(hn::Floor(a.v[i])); }
HWY_INLINE F copy_sign(const F& a, const F& s) { PENUMBRA_LANEWISE(hn::CopySign(a.v[i], s.v[i])); }
HWY_INLINE M operator<(const F& a, const F& b) { PENUMBRA_MASKWISE(hn::Lt(a.v[i], b.v[i])); }
HWY_INLINE M operator>(const F& a, const F& b) { PENUMBRA_MASKWISE(hn::Lt(b.v[i], a.v[i])); }
HWY_INLINE M operator<=(const F& a, const F& b) { PENUMBRA_MASKWISE(hn::Le(a.v[i], b.v[i])); }
HWY_INLINE M operator>=(const F& a, const F& b) { PENUMBRA_MASKWISE(hn::Le(b.v[i], a.v[i])); }
HWY_INLINE M operator&(const M& a, const M& b) { PENUMBRA_MASKWISE(hn::And(a.v[i], b.v[i])); }
HWY_INLINE M operator|(const M& a, const M& b) { PENUMBRA_MASKWISE(hn::Or(a.v[i], b.v[i])); }
HWY_INLINE M operator^(const M& a, const M& b) { PENUMBRA_MASKWISE(hn::Xor(a.v[i], b.v[i])); }
HWY_INLINE M and_not(const M& a, const M& b) { PENUMBRA_MASKWISE(hn::AndNot(a.v[i], b.v[i])); }
HWY_INLINE F select(const M& m, const F& yes, const F& no) {
  PENUMBRA_LANEWISE(hn::IfThenElse(m.v[i], yes.v[i], no.v[i]));
}
HWY_INLINE bool any(const M& m) {
  VM all = m.v[0];
  for (int i = 1; i < vectors; ++i) all = hn::Or(all, m.v[i]);
  return !hn::AllFalse(D(), all);
}
/// Bit i for lane i.
HWY_INLINE std::uint32_t bits(const M& m) {
  std::uint32_t r = 0;
  for (int i = 0; i < vectors; ++i) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(D(), m.v[i], bytes);
    r |= (bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8) << (i * vector_lanes);
  }
  return r;
}
HWY_INLINE M mask_of(std::uint32_t b) {
  M r;
  for (int i = 0; i < vectors; ++i) {
    std::uint8_t bytes[8] = {static_cast<std::uint8_t>(b >> (i * vector_lanes)),
                             static_cast<std::uint8_t>(b >> (i * vector_lanes + 8))};
    r.v[i] = hn::LoadMaskBits(D(), bytes);
  }
  return r;
}
#undef PENUMBRA_LANEWISE
#undef PENUMBRA_MASKWISE

struct P {
  F x, y, z;
};
HWY_INLINE F dot(const P& a, const P& b) { return mad(a.x, b.x, mad(a.y, b.y, a.z * b.z)); }
HWY_INLINE F length(const F& x, const F& y) { return sqrt(mad(x, x, y * y)); }
HWY_INLINE F length(const F& x, const F& y, const F& z) {
  return sqrt(mad(x, x, mad(y, y, z * z)));
}
HWY_INLINE F clamp(const F& x, const F& lo, const F& hi) { return min(max(x, lo), hi); }
/// p − c for constants c.
HWY_INLINE P from(const P& p, const float* c) { return {p.x - c[0], p.y - c[1], p.z - c[2]}; }

}  // namespace penumbra::sdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
