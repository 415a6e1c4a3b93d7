// The field at sixteen points: finds their cells and runs each cell's code once. Included once per
// SIMD target.
#if defined(PENUMBRA_SDF_SAMPLER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_SDF_SAMPLER_INL_H
#undef PENUMBRA_SDF_SAMPLER_INL_H
#else
#define PENUMBRA_SDF_SAMPLER_INL_H
#endif

#include <bit>
#include <vector>

#include "sdf/field_data.h"
#include "sdf/interpret-inl.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::sdf::HWY_NAMESPACE {

/// Memory for slots, one a thread.
template <class A>
Slots<A> slots_for(const Tape& tape) {
  struct alignas(64) Unit {
    float f[16];
  };
  thread_local std::vector<Unit> memory;
  constexpr std::size_t per_value = sizeof(A) / sizeof(Unit), per_point = sizeof(P) / sizeof(Unit);
  const std::size_t units = tape.value_slots * per_value + tape.point_slots * per_point + 1;
  if (memory.size() < units) memory.resize(units);
  return {reinterpret_cast<A*>(memory.data()),
          reinterpret_cast<P*>(memory.data() + tape.value_slots * per_value)};
}

using I = hn::Vec<hn::RebindToSigned<D>>;

class Sampler {
 public:
  explicit Sampler(const FieldData& field)
      : field_(field), regions_(field.regions), slots_(slots_for<F>(field.tape)) {}

  /// Lanes that are not active give anything. One copy of the machine for all callers.
  HWY_NOINLINE F distance(const P& p, std::uint32_t active) {
    HWY_ALIGN std::uint32_t code[lanes];
    find_codes(p, code);
    F result;
    for (bool first = true;; first = false) {
      const std::uint32_t number = code[std::countr_zero(active)];
      const std::uint32_t here = same(code, number);
      const Regions::Code& c = regions_.codes[number];
      ValueMachine machine;
      const F d = run(field_.tape, machine, regions_.words.data() + c.begin, c.count, p, slots_);
      result = first ? d : select(mask_of(here), d, result);
      if (HWY_LIKELY((active &= ~here) == 0)) return result;
    }
  }

  HWY_INLINE void find_codes(const P& p, std::uint32_t* code) const {
    HWY_ALIGN std::int32_t cell[lanes];
    const M in = cells_of(regions_.inner, p, cell, 0);
    if (HWY_UNLIKELY(bits(in) != 0xffff)) {
      HWY_ALIGN std::int32_t other[lanes];
      cells_of(regions_.outer, p, other, 0);
      const std::uint32_t inner = bits(in);
      for (int i = 0; i < lanes; ++i)
        if (!(inner >> i & 1)) cell[i] = other[i];
    }
    const std::uint32_t* cells = regions_.cells.data();
    std::uint32_t all = 0;
    for (int i = 0; i < lanes; ++i) all |= code[i] = cells[cell[i]];
    if (HWY_UNLIKELY(all & Regions::brick_bit)) enter_bricks(p, code);
  }

 private:
  static HWY_INLINE std::uint32_t same(const std::uint32_t* code, std::uint32_t number) {
    const hn::CappedTag<std::uint32_t, 16> d;
    std::uint32_t r = 0;
    for (int i = 0; i < vectors; ++i) {
      std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(d, hn::Eq(hn::Load(d, code + i * vector_lanes), hn::Set(d, number)), bytes);
      r |= (bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8) << (i * vector_lanes);
    }
    return r;
  }

  // Index of each point's cell, 0 (the whole code) outside; the mask says which are inside.
  HWY_INLINE M cells_of(const RegionGrid& g, const P& p, std::int32_t* cell, int) const {
    const F x = floor((p.x - g.lo.x) * g.inverse), y = floor((p.y - g.lo.y) * g.inverse),
            z = floor((p.z - g.lo.z) * g.inverse);
    const auto nx = static_cast<float>(g.count[0]), ny = static_cast<float>(g.count[1]),
               nz = static_cast<float>(g.count[2]);
    const M in = (min(x, min(y, z)) >= F(0.0f)) & (x < F(nx)) & (y < F(ny)) & (z < F(nz));
    const F index = select(in, mad(mad(z, ny, y), nx, x + static_cast<float>(g.first)), 0.0f);
    const hn::RebindToSigned<D> di;
    for (int i = 0; i < vectors; ++i)
      hn::Store(hn::ConvertTo(di, index.v[i]), di, cell + i * vector_lanes);
    return in;
  }

  HWY_NOINLINE void enter_bricks(const P& p, std::uint32_t* code) const {
    HWY_ALIGN float x[lanes], y[lanes], z[lanes];
    store(p.x, x), store(p.y, y), store(p.z, z);
    for (int i = 0; i < lanes; ++i)
      if (code[i] & Regions::brick_bit) code[i] = region_of(regions_, {x[i], y[i], z[i]});
  }

  const FieldData& field_;
  const Regions& regions_;
  Slots<F> slots_;
};

}  // namespace penumbra::sdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
