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
#include "sdf/runs-inl.h"

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

class Sampler {
 public:
  explicit Sampler(const FieldData& field)
      : field_(field),
        regions_(field.regions),
        slots_(slots_for<F>(field.tape)),
        skips_(field.tape.has_groups || !field.tape.runs.empty()) {}

  /// Lanes that are not active give anything. One copy of the machine for all callers.
  /// most: what f cannot be above at the points, from a value nearby and the way from there (slopes
  /// are at most 1); only saves time.
  HWY_NOINLINE F distance(const P& p, std::uint32_t active, const F& most) {
    Groups groups;
    find(p, active, groups);
    if (HWY_UNLIKELY(skips_ && groups.count > 1)) prefer_whole(groups);
    F result;
    for (int i = 0;;) {
      const Regions::Code& c = regions_.codes[groups.code[i]];
      ValueMachine machine(most);
      const bool whole = groups.code[i] == 0 && !field_.tape.runs.empty();
      const F d = HWY_UNLIKELY(whole) ? whole_value(p, active, machine)
                                      : run(field_.tape, machine, regions_.words.data() + c.begin,
                                            c.count, p, slots_);
      result = i == 0 ? d : select(mask_of(groups.members[i]), d, result);
      if (HWY_LIKELY(++i == groups.count)) return result;
    }
  }

  /// Lanes with the same code; every active lane is in one group.
  struct Groups {
    int count = 0;
    std::uint32_t code[16], members[16];

    HWY_INLINE void add(std::uint32_t number, std::uint32_t which) {
      for (int i = 0; i < count; ++i)
        if (code[i] == number) {
          members[i] |= which;
          return;
        }
      code[count] = number, members[count++] = which;
    }
  };

  HWY_INLINE void find(const P& p, std::uint32_t active, Groups& groups) const {
    Cells cell;
    const std::uint32_t inner = bits(cells_of(regions_.inner, p, cell)) & active;
    std::uint32_t bricks = 0;
    if (HWY_LIKELY(inner != 0)) bricks = group(cell, inner, groups);
    if (HWY_UNLIKELY(inner != active)) {
      cells_of(regions_.outer, p, cell);
      bricks |= group(cell, active & ~inner, groups);
    }
    if (HWY_UNLIKELY(bricks != 0)) enter_bricks(p, bricks, groups);
  }

 private:
  // The whole code, whose runs leave out what is far.
  HWY_NOINLINE F whole_value(P p, std::uint32_t active, ValueMachine& machine) {
    const Tape& tape = field_.tape;
    const Word* code = regions_.words.data() + regions_.codes[0].begin;
    F acc{};
    std::size_t at = 0;
    for (const Run& r : tape.runs) {
      run(tape, machine, code + at, r.begin - at, slots_, p, acc);
      acc = RunWalker(tape, r).join(p, acc, active);
      at = std::size_t{r.begin} + r.count;
    }
    run(tape, machine, code + at, regions_.codes[0].count - at, slots_, p, acc);
    return acc;
  }

  /// Words that several cells' codes may have together before the whole code with its guards and
  /// runs, once for all lanes, is cheaper.
  static constexpr std::uint32_t many_words = 40;

  HWY_INLINE void prefer_whole(Groups& groups) const {
    std::uint32_t words = 0;
    for (int i = 0; i < groups.count; ++i) words += regions_.codes[groups.code[i]].count;
    if (words > many_words) groups.count = 1, groups.code[0] = 0;
  }

  using DI = hn::RebindToSigned<D>;
  struct Cells {
    hn::Vec<DI> v[vectors];
  };

  // Adds the lanes by the code of their cell; gives those whose cell is a brick.
  HWY_INLINE std::uint32_t group(const Cells& cell, std::uint32_t left, Groups& groups) const {
    const DI d;
    const auto* entries = reinterpret_cast<const std::int32_t*>(regions_.cells.data());
    HWY_ALIGN std::int32_t numbers[lanes];
    Cells code;
    for (int i = 0; i < vectors; ++i) {
      code.v[i] = hn::GatherIndex(d, entries, cell.v[i]);
      hn::Store(code.v[i], d, numbers + i * vector_lanes);
    }
    std::uint32_t bricks = 0;
    while (true) {
      const std::int32_t first = numbers[std::countr_zero(left)];
      const std::uint32_t here = same(code, first) & left;
      if (first < 0)
        bricks |= negative(code) & left, left &= ~bricks;
      else
        groups.add(static_cast<std::uint32_t>(first), here), left &= ~here;
      if (HWY_LIKELY(left == 0)) return bricks;
    }
  }

  static HWY_INLINE std::uint32_t same(const Cells& cell, std::int32_t value) {
    M m;
    for (int i = 0; i < vectors; ++i)
      m.v[i] = hn::RebindMask(D(), hn::Eq(cell.v[i], hn::Set(DI(), value)));
    return bits(m);
  }
  static HWY_INLINE std::uint32_t negative(const Cells& cell) {
    M m;
    for (int i = 0; i < vectors; ++i)
      m.v[i] = hn::RebindMask(D(), hn::Lt(cell.v[i], hn::Zero(DI())));
    return bits(m);
  }

  // Index of each point's cell, 0 (the whole code) outside; the mask says which are inside.
  HWY_INLINE M cells_of(const RegionGrid& g, const P& p, Cells& cell) const {
    const F x = floor((p.x - g.lo.x) * g.inverse), y = floor((p.y - g.lo.y) * g.inverse),
            z = floor((p.z - g.lo.z) * g.inverse);
    const auto nx = static_cast<float>(g.count[0]), ny = static_cast<float>(g.count[1]),
               nz = static_cast<float>(g.count[2]);
    const M in = (min(x, min(y, z)) >= F(0.0f)) & (x < F(nx)) & (y < F(ny)) & (z < F(nz));
    const F index = select(in, mad(mad(z, ny, y), nx, x + static_cast<float>(g.first)), 0.0f);
    for (int i = 0; i < vectors; ++i) cell.v[i] = hn::ConvertTo(DI(), index.v[i]);
    return in;
  }

  HWY_NOINLINE void enter_bricks(const P& p, std::uint32_t left, Groups& groups) const {
    HWY_ALIGN float x[lanes], y[lanes], z[lanes];
    store(p.x, x), store(p.y, y), store(p.z, z);
    for (; left; left &= left - 1) {
      const int i = std::countr_zero(left);
      groups.add(region_of(regions_, {x[i], y[i], z[i]}), 1u << i);
    }
  }

  const FieldData& field_;
  const Regions& regions_;
  Slots<F> slots_;
  bool skips_;
};

}  // namespace penumbra::sdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
