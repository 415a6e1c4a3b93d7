// A run of shapes for a packet of points: those whose boxes are too far from all of them are left
// out. Included once per SIMD target.
#if defined(PENUMBRA_SDF_RUNS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_SDF_RUNS_INL_H
#undef PENUMBRA_SDF_RUNS_INL_H
#else
#define PENUMBRA_SDF_RUNS_INL_H
#endif

#include <bit>
#include <cmath>
#include <vector>

#include "sdf/interpret-inl.h"
#include "sdf/runs.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::sdf::HWY_NAMESPACE {

class RunWalker {
 public:
  RunWalker(const Tape& tape, const Run& run) : tape_(tape), run_(run) {}

  /// The accumulator after the run. Lanes that are not active give anything.
  HWY_NOINLINE F join(const P& p, const F& before, std::uint32_t active_bits) {
    struct alignas(64) Unit {
      float f[lanes];
    };
    thread_local std::vector<Unit> memory;
    thread_local std::vector<std::uint64_t> marks;
    memory.resize(run_.clusters);
    marks.assign(run_.count / 64 + 1, 0);
    const M active = mask_of(active_bits);
    F acc = before;
    float* far = memory.front().f;
    look_at_clusters(p, select(active, acc + run_.k, -INFINITY), far, marks.data());
    const ValueMachine machine(1e30f);
    const Word* code = tape_.code.data() + run_.begin;
    for (std::size_t w = 0; w < marks.size(); ++w)
      for (std::uint64_t left = marks[w]; left; left &= left - 1) {
        const std::size_t i = w * 64 + static_cast<std::size_t>(std::countr_zero(left));
        const F limit = select(active, acc + run_.k, -INFINITY);
        if (!any(load(far + std::size_t{lanes} * run_.cluster_of[i]) < limit)) continue;
        const float* record = tape_.record(code[i]);
        const Header& header = *reinterpret_cast<const Header*>(record);
        acc = machine.join(join_of(code[i]), header, acc,
                           shape_value(tape_, header.op, p, record + 4));
      }
    return acc;
  }

 private:
  // far: for each cluster what its shapes' values are not below, lane by lane, with room for
  // rounding here and in the shapes; −∞ where it may overlap. Marks the shapes of those that are
  // below the limit somewhere.
  HWY_INLINE void look_at_clusters(const P& p, const F& limit, float* far,
                                   std::uint64_t* marks) const {
    const F room = max(abs(p.x), max(abs(p.y), abs(p.z))) * 1e-5f;
    for (std::uint32_t c = 0; c < run_.clusters; ++c) {
      const float* box = run_.boxes.data() + 6 * std::size_t{c};
      const P q = from(p, box);
      const F x = max(abs(q.x) - box[3], 0.0f), y = max(abs(q.y) - box[4], 0.0f),
              z = max(abs(q.z) - box[5], 0.0f);
      const F sure = nmad(length(x, y, z), -0.9999f, -room);
      const F least = select(sure > F(0.0f), sure, -INFINITY);
      store(least, far + std::size_t{lanes} * c);
      if (!any(least < limit)) continue;
      for (std::uint32_t i = run_.first_member[c]; i < run_.first_member[c + 1]; ++i)
        marks[run_.members[i] / 64] |= std::uint64_t{1} << (run_.members[i] % 64);
    }
  }

  const Tape& tape_;
  const Run& run_;
};

}  // namespace penumbra::sdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
