// The machine that finds the range of every value within cells: one cell a lane. Included once per
// SIMD target.
#if defined(PENUMBRA_SDF_INTERVALS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_SDF_INTERVALS_INL_H
#undef PENUMBRA_SDF_INTERVALS_INL_H
#else
#define PENUMBRA_SDF_INTERVALS_INL_H
#endif

#include <array>
#include <vector>

#include "sdf/interpret-inl.h"
#include "sdf/prune.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::sdf::HWY_NAMESPACE {

struct Interval {
  F lo, hi;
};

/// Shapes range by their Lipschitz constant times the cell's radius; what joins them is monotonous,
/// so that ends give ends.
struct IntervalMachine {
  using Acc = Interval;
  static constexpr bool skips = false;
  F radius, slack;
  Ranges* out;
  F doubt;  ///< added to every reach; large where a cell spans two copies of a repetition
  std::vector<std::array<float, lanes>> outer_doubt;  ///< by slot

  HWY_INLINE IntervalMachine(const F& r, const F& s, Ranges* to)
      : radius(r), slack(s), out(to), doubt(0.0f) {}

  HWY_INLINE Interval about(const F& v, const Tape& tape, Word w) const {
    const WordInfo& info = tape.info[tape.place(w)];
    const F reach = radius * info.lipschitz + mad(abs(v), 1e-5f + info.doubt, slack) + doubt;
    return {v - reach, v + reach};
  }
  HWY_INLINE Interval acc_of(const Tape& tape, Word w, const Header&, const F& v) const {
    return about(v, tape, w);
  }
  HWY_INLINE Interval join(Join join, const Header& h, const Interval& a, const Interval& v) const {
    const ValueMachine machine(0.0f);
    const bool negative =
        join == Join::load_negative || join == Join::max_negative || join == Join::smax_negative;
    return {machine.join(join, h, a.lo, negative ? v.hi : v.lo),
            machine.join(join, h, a.hi, negative ? v.lo : v.hi)};
  }
  HWY_INLINE Interval multiply(const Interval& a, float x) const { return {a.lo * x, a.hi * x}; }
  HWY_INLINE Interval onion(const Interval& a, float t) const {
    const F most = max(abs(a.lo), abs(a.hi));
    const F least = max(max(a.lo, -a.hi), 0.0f);
    return {least - t, most - t};
  }
  HWY_INLINE Interval round(const Interval& a, float r) const { return {a.lo - r, a.hi - r}; }
  HWY_INLINE Interval add(const Interval& a, const F& d, const Tape& tape, Word w) const {
    const Interval more = about(d, tape, w);
    return {a.lo + more.lo, a.hi + more.hi};
  }
  HWY_INLINE Interval unbend(const Interval& e, const Interval& a, const Tape& tape, Word w) const {
    const F reach = radius * tape.info[tape.place(w)].lipschitz + slack;
    return {beyond(max(e.lo - reach, 0.0f), a.lo), beyond(e.hi + reach, a.hi)};
  }
  HWY_INLINE Interval stored(const F& e) const { return {e, e}; }
  HWY_INLINE void before_join(std::size_t i, const Interval& a, const Interval& v) {
    Ranges& r = out[i];
    store(a.lo, r.acc_lo), store(a.hi, r.acc_hi);
    store(v.lo, r.v_lo), store(v.hi, r.v_hi);
  }
  /// One copy of a repetition jumps at the borders of its cells, the next one in their middle too.
  void enter(const Tape& tape, Word w, const float* record, const P& p) {
    const Header& header = *reinterpret_cast<const Header*>(record);
    if (outer_doubt.size() <= header.slot) outer_doubt.resize(header.slot + std::size_t{1});
    store(doubt, outer_doubt[header.slot].data());
    if (header.op != Op::nearest_copy) return;
    const float* c = record + 4;
    const P q = from(p, c);
    const F reach = radius * (1.001f * tape.info[tape.place(w)].lipschitz) + slack;
    const F* along[3] = {&q.x, &q.y, &q.z};
    for (int i = 0; i < 3; ++i) {
      if (c[3 + i] == 0 || c[15 + i] != 0) continue;
      const float halves = 2 * c[6 + i];
      const F first = floor((*along[i] - reach) * halves),
              last = floor((*along[i] + reach) * halves);
      doubt = select(first < last, 1e30f, doubt);
    }
  }
  void leave(std::uint32_t slot) { doubt = load(outer_doubt[slot].data()); }
};

}  // namespace penumbra::sdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
