// The machine that also knows which shape made each value. Included once per SIMD target.
#if defined(PENUMBRA_SDF_OWNERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_SDF_OWNERS_INL_H
#undef PENUMBRA_SDF_OWNERS_INL_H
#else
#define PENUMBRA_SDF_OWNERS_INL_H
#endif

#include "sdf/sampler-inl.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::sdf::HWY_NAMESPACE {

/// A value, its surface's index (exact in a float), and more than 0 where surfaces blend.
struct Owned {
  F value, surface, blend;
};

struct OwnerMachine {
  using Acc = Owned;
  static constexpr bool skips = true;
  HWY_INLINE const F& limit(const Owned& a, const Header&) const { return a.value; }
  HWY_INLINE Owned acc_of(const Tape&, Word, const Header& h, const F& v) const {
    return {v, static_cast<float>(h.surface), 0.0f};
  }
  HWY_INLINE Owned join(Join join, const Header& h, const Owned& a, const Owned& v) const {
    Owned r;
    r.value = ValueMachine(0.0f).join(join, h, a.value, v.value);
    const bool negative = join == Join::max_negative || join == Join::smax_negative;
    const F other = negative ? -v.value : v.value;
    const bool least = join == Join::min || join == Join::smin;
    M takes_v = least ? other < a.value : other > a.value;
    if (join <= Join::load_negative) takes_v = F(0.0f) <= F(0.0f);
    r.surface = select(takes_v, v.surface, a.surface);
    r.blend = select(takes_v, v.blend, a.blend);
    if (join >= Join::smin) {
      const F h_over_k = max(1.0f - abs(a.value - other) * (1 / h.k), 0.0f);
      const M both = h_over_k > F(1e-3f), differ = abs(a.surface - v.surface) > F(0.5f);
      r.blend = select(both, max(max(a.blend, v.blend), select(differ, 1.0f, 0.0f)), r.blend);
    }
    return r;
  }
  HWY_INLINE Owned with(const Owned& a, const F& value) const {
    return {value, a.surface, a.blend};
  }
  HWY_INLINE Owned multiply(const Owned& a, float x) const { return with(a, a.value * x); }
  HWY_INLINE Owned onion(const Owned& a, float t) const { return with(a, abs(a.value) - t); }
  HWY_INLINE Owned round(const Owned& a, float r) const { return with(a, a.value - r); }
  HWY_INLINE Owned add(const Owned& a, const F& d, const Tape&, Word) const {
    return with(a, a.value + d);
  }
  HWY_INLINE Owned unbend(const Owned& e, const Owned& a, const Tape&, Word) const {
    return with(a, beyond(e.value, a.value));
  }
  HWY_INLINE Owned stored(const F& e) const { return {e, 0.0f, 0.0f}; }
  HWY_INLINE void before_join(std::size_t, const Owned&, const Owned&) {}
  HWY_INLINE void enter(const Tape&, Word, const float*, const P&) {}
  HWY_INLINE void leave(std::uint32_t) {}
};

HWY_INLINE void find_owners(const FieldData& field, const P& p, std::size_t count,
                            std::uint32_t* surface, std::uint8_t* blended) {
  HWY_ALIGN float owner[lanes], blend[lanes];
  Sampler::Groups groups;
  Sampler(field).find(p, count == lanes ? 0xffffu : (1u << count) - 1, groups);
  const Slots<Owned> slots = slots_for<Owned>(field.tape);
  for (int i = 0; i < groups.count; ++i) {
    const Regions::Code& c = field.regions.codes[groups.code[i]];
    OwnerMachine machine;
    const Owned found =
        run(field.tape, machine, field.regions.words.data() + c.begin, c.count, p, slots);
    store(found.surface, owner), store(found.blend, blend);
    for (std::uint32_t b = groups.members[i]; b; b &= b - 1) {
      const int lane = std::countr_zero(b);
      surface[lane] = static_cast<std::uint32_t>(owner[lane]);
      blended[lane] = blend[lane] > 0;
    }
  }
}

}  // namespace penumbra::sdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
