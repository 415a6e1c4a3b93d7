// Runs a tape for sixteen points. Included once per SIMD target.
#if defined(PENUMBRA_SDF_INTERPRET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_SDF_INTERPRET_INL_H
#undef PENUMBRA_SDF_INTERPRET_INL_H
#else
#define PENUMBRA_SDF_INTERPRET_INL_H
#endif

#include <hwy/contrib/math/math-inl.h>

#include "sdf/mesh_distance.h"
#include "sdf/shapes-inl.h"
#include "sdf/tape.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::sdf::HWY_NAMESPACE {

HWY_INLINE F sine(const F& a) {
  F r;
  for (int i = 0; i < vectors; ++i) r.v[i] = hn::Sin(D(), a.v[i]);
  return r;
}
HWY_INLINE F cosine(const F& a) {
  F r;
  for (int i = 0; i < vectors; ++i) r.v[i] = hn::Cos(D(), a.v[i]);
  return r;
}

/// Slots for points, and for accumulators of whatever kind A.
template <class A>
struct Slots {
  A* values;
  P* points;
};

HWY_NOINLINE F mesh_value(const Tape& tape, const float* c, const P& p) {
  HWY_ALIGN float x[lanes], y[lanes], z[lanes], out[lanes];
  store(p.x, x), store(p.y, y), store(p.z, z);
  tape.meshes[static_cast<std::size_t>(c[0])]->distance(x, y, z, lanes, out);
  return load(out);
}

HWY_INLINE F revolved(const P& q, const float* c, F& y) {
  y = q.y;
  return length(q.x, q.z) - c[3];
}

// The rarer shapes, kept out of the main loop's registers.
HWY_NOINLINE F rare_value(const Tape& tape, Op op, const P& p, const float* c) {
  F y;
  switch (op) {
    case Op::ellipsoid:
      return ellipsoid(p, c);
    case Op::capped_torus:
      return capped_torus(p, c);
    case Op::capped_cone:
      return capped_cone(p, c);
    case Op::cone:
      return cone(p, c);
    case Op::hexagonal_prism:
      return hexagonal_prism(p, c);
    case Op::octahedron:
      return octahedron(p, c);
    case Op::link:
      return link(p, c);
    case Op::extrude_circle:
      return corner(circle(p.x - c[0], p.y - c[1], c + 4), abs(p.z - c[2]) - c[3]);
    case Op::extrude_box:
      return corner(rectangle(p.x - c[0], p.y - c[1], c + 4), abs(p.z - c[2]) - c[3]);
    case Op::extrude_polygon:
      return corner(polygon(p.x - c[0], p.y - c[1], c + 4), abs(p.z - c[2]) - c[3]);
    case Op::revolve_circle: {
      const F x = revolved(from(p, c), c, y);
      return circle(x, y, c + 4);
    }
    case Op::revolve_box: {
      const F x = revolved(from(p, c), c, y);
      return rectangle(x, y, c + 4);
    }
    case Op::revolve_polygon: {
      const F x = revolved(from(p, c), c, y);
      return polygon(x, y, c + 4);
    }
    case Op::flat_polygon:
      return flat_polygon(p, c);
    default:
      return mesh_value(tape, c, p);
  }
}

HWY_INLINE F shape_value(const Tape& tape, Op op, const P& p, const float* c) {
  switch (op) {
    case Op::sphere:
      return sphere(p, c);
    case Op::box:
      return box(p, c);
    case Op::round_box:
      return round_box(p, c);
    case Op::torus:
      return torus(p, c);
    case Op::capsule:
      return capsule(p, c);
    case Op::cylinder:
      return cylinder(p, c);
    case Op::plane:
      return plane(p, c);
    default:
      return rare_value(tape, op, p, c);
  }
}

/// Is the guard's box farther away than d everywhere? c = centre, half size.
HWY_INLINE bool is_beyond(const P& p, const float* c, const F& d) {
  const P q = from(p, c);
  const F x = max(abs(q.x) - c[3], 0.0f), y = max(abs(q.y) - c[4], 0.0f),
          z = max(abs(q.z) - c[5], 0.0f);
  const F square = mad(x, x, mad(y, y, z * z)), far = max(d, 0.0f);
  return bits(square > far * far) == 0xffff;
}

/// sin(fx x) sin(fy y) sin(fz z) times the amplitude.
HWY_NOINLINE F displacement(const P& p, const float* c) {
  const P q = from(p, c);
  return sine(q.x * c[4]) * sine(q.y * c[5]) * sine(q.z * c[6]) * c[3];
}

HWY_INLINE F copy_along(const F& q, const float* c, int axis) {
  const F size = c[3 + axis], limit = c[9 + axis];
  F id = clamp(round(q * c[6 + axis]), -limit, limit);
  if (c[12 + axis] != 0) {
    const F way = copy_sign(1.0f, nmad(size, id, q));
    id = clamp(id + way, -limit, limit);
  }
  return nmad(size, id, q);
}

/// Pulls (u, v) back to `reach` from the axis; gives how far beyond it was.
HWY_INLINE F pull_back(F& u, F& v, float reach) {
  const F r = length(u, v);
  const F shrink = select(r > F(reach), F(reach) / max(r, 1e-30f), 1.0f);
  u = u * shrink, v = v * shrink;
  return max(r - reach, 0.0f);
}
HWY_INLINE void turn_by(F& u, F& v, const F& angle) {
  const F c = cosine(angle), s = sine(angle), w = mad(c, u, s * v);
  v = c * v - s * u;
  u = w;
}

/// The point's ops; twist and bend give e as well.
HWY_NOINLINE P moved_point(Op op, const P& p, const float* c, F& e) {
  P q = from(p, c);
  switch (op) {
    case Op::turn:
      return {mad(q.x, c[3], mad(q.y, c[4], q.z * c[5])),
              mad(q.x, c[6], mad(q.y, c[7], q.z * c[8])),
              mad(q.x, c[9], mad(q.y, c[10], q.z * c[11]))};
    case Op::stretch:
      return {q.x * c[3], q.y * c[4], q.z * c[5]};
    case Op::fold:
      if (c[3] != 0) q.x = abs(q.x);
      if (c[4] != 0) q.y = abs(q.y);
      if (c[5] != 0) q.z = abs(q.z);
      return q;
    case Op::nearest_copy:
      if (c[3] > 0) q.x = copy_along(q.x, c, 0);
      if (c[4] > 0) q.y = copy_along(q.y, c, 1);
      if (c[5] > 0) q.z = copy_along(q.z, c, 2);
      return q;
    case Op::twist:
      e = pull_back(q.x, q.z, c[4]);
      turn_by(q.x, q.z, q.y * c[3]);
      return q;
    case Op::bend:
      e = pull_back(q.x, q.y, c[4]);
      turn_by(q.x, q.y, q.x * c[3]);
      return q;
    default:  // elongate
      return {q.x - clamp(q.x, -c[3], c[3]), q.y - clamp(q.y, -c[4], c[4]),
              q.z - clamp(q.z, -c[5], c[5])};
  }
}

HWY_INLINE F beyond(const F& e, const F& d) {
  const F near_d = max(d, 0.0f);
  return select(e > F(0.0f), sqrt(mad(e, e, near_d * near_d)), d);
}

/// Quilez, "smooth minimum": quadratic. a, v: both values; k > 0.
HWY_INLINE F smooth_min(const F& a, const F& v, float k, float quarter_over_k) {
  const F h = max(F(k) - abs(a - v), 0.0f);
  return nmad(h * h, quarter_over_k, min(a, v));
}
HWY_INLINE F smooth_max(const F& a, const F& v, float k, float quarter_over_k) {
  const F h = max(F(k) - abs(a - v), 0.0f);
  return mad(h * h, quarter_over_k, max(a, v));
}

/// The machine that evaluates: its accumulator is a value.
struct ValueMachine {
  using Acc = F;
  static constexpr bool skips = true;
  /// Known beforehand: no lane's result is above.
  F most;
  HWY_INLINE explicit ValueMachine(const F& known) : most(known) {}
  HWY_INLINE F limit(const F& a, const Header& guard) const {
    return guard.slot ? min(a, most) : a;
  }
  HWY_INLINE F acc_of(const Tape&, Word, const Header&, const F& v) const { return v; }
  HWY_INLINE F join(Join join, const Header& h, const F& a, const F& v) const {
    switch (join) {
      case Join::load:
        return v;
      case Join::load_negative:
        return -v;
      case Join::min:
        return min(a, v);
      case Join::max:
        return max(a, v);
      case Join::max_negative:
        return max(a, -v);
      case Join::smin:
        return smooth_min(a, v, h.k, h.quarter_over_k);
      case Join::smax:
        return smooth_max(a, v, h.k, h.quarter_over_k);
      default:
        return smooth_max(a, -v, h.k, h.quarter_over_k);
    }
  }
  HWY_INLINE F multiply(const F& a, float x) { return a * x; }
  HWY_INLINE F onion(const F& a, float t) { return abs(a) - t; }
  HWY_INLINE F round(const F& a, float r) { return a - r; }
  HWY_INLINE F add(const F& a, const F& d, const Tape&, Word) { return a + d; }
  HWY_INLINE F unbend(const F& e, const F& a, const Tape&, Word) { return beyond(e, a); }
  HWY_INLINE F stored(const F& e) { return e; }
  HWY_INLINE void before_join(std::size_t, const F&, const F&) {}
  HWY_INLINE void enter(const Tape&, Word, const float*, const P&) {}
  HWY_INLINE void leave(std::uint32_t) {}
};

template <class Machine, class Acc>
HWY_NOINLINE void act(const Tape& tape, Machine& machine, Word w, Op op, const float* record, P& p,
                      Acc& acc, const Slots<Acc>& slots) {
  const Header& header = *reinterpret_cast<const Header*>(record);
  const float* c = record + 4;
  switch (op) {
    case Op::multiply:
      acc = machine.multiply(acc, c[0]);
      return;
    case Op::onion:
      acc = machine.onion(acc, c[0]);
      return;
    case Op::round:
      acc = machine.round(acc, c[0]);
      return;
    case Op::displace:
      acc = machine.add(acc, displacement(p, c), tape, w);
      return;
    case Op::unbend:
      acc = machine.unbend(slots.values[header.slot], acc, tape, w);
      p = slots.points[static_cast<std::size_t>(c[0])];
      return;
    case Op::twist:
    case Op::bend: {
      F e;
      slots.points[static_cast<std::size_t>(c[5])] = p;
      p = moved_point(op, p, c, e);
      slots.values[header.slot] = machine.stored(e);
      return;
    }
    default: {
      F unused;
      slots.points[header.slot] = p;
      machine.enter(tape, w, record, p);
      p = moved_point(op, p, c, unused);
    }
  }
}

/// Goes on from `acc` and `p`.
template <class Machine, class Acc = typename Machine::Acc>
HWY_INLINE void run(const Tape& tape, Machine& machine, const Word* code, std::size_t count,
                    const Slots<Acc>& slots, P& p, Acc& acc) {
  const float* const pool = tape.pool.data();
  for (std::size_t i = 0; i < count; ++i) {
    const Word w = code[i];
    const float* record = pool + 4 * std::size_t{w & offset_mask};
    const Header& header = *reinterpret_cast<const Header*>(record);
    const Op op = header.op;
    if (HWY_LIKELY(is_shape(op))) {
      const Acc v = machine.acc_of(tape, w, header, shape_value(tape, op, p, record + 4));
      machine.before_join(i, acc, v);
      acc = machine.join(join_of(w), header, acc, v);
    } else if (op == Op::guard) {
      ++i;
      if constexpr (Machine::skips)
        if (is_beyond(p, record + 4, machine.limit(acc, header))) i += code[i] & ~count_mark;
    } else if (op == Op::pop) {
      p = slots.points[header.slot];
      machine.leave(header.slot);
    } else if (op == Op::spill) {
      slots.values[header.slot] = acc;
    } else if (op == Op::restore) {
      const Acc v = acc;
      acc = slots.values[header.slot];
      machine.before_join(i, acc, v);
      acc = machine.join(join_of(w), header, acc, v);
    } else {
      act(tape, machine, w, op, record, p, acc, slots);
    }
  }
}

template <class Machine, class Acc = typename Machine::Acc>
HWY_INLINE Acc run(const Tape& tape, Machine& machine, const Word* code, std::size_t count, P p,
                   const Slots<Acc>& slots) {
  Acc acc{};
  run(tape, machine, code, count, slots, p, acc);
  return acc;
}

}  // namespace penumbra::sdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
