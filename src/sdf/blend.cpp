#include "sdf/blend.h"

#include <algorithm>
#include <cmath>

#include "sdf/field_data.h"

namespace penumbra::sdf {
namespace {

/// Weights below this are left out.
constexpr float least_weight = 1e-3f;

struct Part {
  std::uint32_t surface;
  float weight;
};
using Mix = std::vector<Part>;

Mix mix(const Mix& a, const Mix& b, float weight_of_b) {
  Mix m;
  const auto add = [&](const Mix& parts, float weight) {
    for (const Part& part : parts) {
      const auto known = std::ranges::find(m, part.surface, &Part::surface);
      if (known != m.end())
        known->weight += part.weight * weight;
      else if (part.weight * weight > least_weight)
        m.push_back({part.surface, part.weight * weight});
    }
  };
  add(a, 1 - weight_of_b);
  add(b, weight_of_b);
  return m;
}

// The weight of v where it joins a.
float weight_of(Join join, float k, float a, float v) {
  if (join <= Join::load_negative) return 1;
  const bool negative = join == Join::max_negative || join == Join::smax_negative;
  const float other = negative ? -v : v;
  const bool least = join == Join::min || join == Join::smin;
  const bool takes_v = least ? other < a : other > a;
  if (join < Join::smin) return takes_v ? 1.0f : 0.0f;
  const float h = std::max(1 - std::abs(a - other) / k, 0.0f), farther = 0.5f * h * h;
  return takes_v ? 1 - farther : farther;
}

}  // namespace

SurfaceAt blend_at(const FieldData& field, const Vec3& p) {
  const Tape& tape = field.tape;
  const Regions::Code& c = field.regions.codes[region_of(field.regions, p)];
  const std::span code(field.regions.words.data() + c.begin, c.count);
  // A cell without extent: the ranges are the values, but for room for rounding on both sides.
  Cells cells;
  std::fill_n(cells.x, 16, p.x), std::fill_n(cells.y, 16, p.y), std::fill_n(cells.z, 16, p.z);
  std::fill_n(cells.radius, 16, 0.0f);
  std::vector<Ranges> ranges;
  ranges_in(tape, code, cells, ranges);
  std::vector<Mix> slots(tape.value_slots);
  Mix acc;
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (is_count(code[i])) continue;
    const Header& h = tape.header(code[i]);
    if (h.op == Op::spill) slots[h.slot] = acc;
    if (!is_shape(h.op) && h.op != Op::restore) continue;
    const Mix v = is_shape(h.op) ? Mix{{h.surface, 1.0f}} : acc;
    if (h.op == Op::restore) acc = slots[h.slot];
    const Ranges& r = ranges[i];
    acc = mix(acc, v,
              weight_of(join_of(code[i]), h.k, 0.5f * (r.acc_lo[0] + r.acc_hi[0]),
                        0.5f * (r.v_lo[0] + r.v_hi[0])));
  }
  SurfaceAt at;
  float sum = 0;
  for (const Part& part : acc) sum += part.weight;
  for (const Part& part : acc) {
    const Surface& s = tape.surfaces[part.surface];
    at.object = s.object;
    at.parts.push_back({s.material, part.weight / sum});
  }
  return at;
}

}  // namespace penumbra::sdf
