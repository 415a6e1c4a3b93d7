// Normals, and points put back onto the surface. Included once per SIMD target.
#if defined(PENUMBRA_SDF_SURFACES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_SDF_SURFACES_INL_H
#undef PENUMBRA_SDF_SURFACES_INL_H
#else
#define PENUMBRA_SDF_SURFACES_INL_H
#endif

#include "sdf/march-inl.h"
#include "sdf/met_surface.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::sdf::HWY_NAMESPACE {

/// The mean of differences over 1 from which a surface counts as bent, and over what part of the
/// way they are then taken.
constexpr float bend_of_differences = 0.02f, closer_differences = 1.0f / 16;

/// The sums of four differences over e (Quilez, "normals for an SDF": the corners of a
/// tetrahedron), and their mean, which is f(p) where f is flat.
struct Differences {
  P sums;
  F mean;
};

HWY_INLINE Differences differences_at(Sampler& sampler, const FieldData& field, const P& p,
                                      const F& e) {
  constexpr float signs[4][3] = {{1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, 1, 1}};
  F d[4], most = 1e30f;
  for (int k = 0; k < 4; ++k) {
    const P q{mad(e, signs[k][0], p.x), mad(e, signs[k][1], p.y), mad(e, signs[k][2], p.z)};
    d[k] = sampler.distance(q, all_lanes, most);
    most = most_after(field, d[k], e * 2.83f, q);
  }
  return {
      {(d[0] - d[1]) + (d[3] - d[2]), (d[2] - d[0]) + (d[3] - d[1]), (d[1] - d[0]) + (d[3] - d[2])},
      ((d[0] + d[1]) + (d[2] + d[3])) * 0.25f};
}

HWY_INLINE P unit(const P& s) {
  const F size = length(s.x, s.y, s.z);
  const M known = size > F(0.0f);
  return {select(known, s.x / size, 0.0f), select(known, s.y / size, 1.0f),
          select(known, s.z / size, 0.0f)};
}

/// Where f grows, by differences over e; unit.
HWY_INLINE P normal_at(Sampler& sampler, const FieldData& field, const P& p, const F& e) {
  return unit(differences_at(sampler, field, p, e).sums);
}

/// The same at points of the surface: where the differences tell of a bend, as beside an edge,
/// closer ones.
HWY_INLINE P surface_normal_at(Sampler& sampler, const FieldData& field, const P& p, const F& e) {
  const Differences d = differences_at(sampler, field, p, e);
  const M bent = abs(d.mean) > e * bend_of_differences;
  if (HWY_LIKELY(!any(bent))) return unit(d.sums);
  const P closer = differences_at(sampler, field, p, e * closer_differences).sums;
  return unit({select(bent, closer.x, d.sums.x), select(bent, closer.y, d.sums.y),
               select(bent, closer.z, d.sums.z)});
}

HWY_INLINE F greatest(const P& p) { return max(abs(p.x), max(abs(p.y), abs(p.z))); }
/// Field::normal_step().
HWY_INLINE F normal_step(const P& p) { return max(greatest(p), 1e-3f) * 1e-3f; }
HWY_INLINE P along(const P& p, const P& d, const F& t) {
  return {mad(d.x, t, p.x), mad(d.y, t, p.y), mad(d.z, t, p.z)};
}

/// Sixteen meeting points, and what becomes of them. Lanes past the end repeat the last.
class SurfaceLanes {
 public:
  SurfaceLanes(const MeetingPoint* met, std::size_t count) : count_(count) {
    for (std::size_t i = 0; i < lanes; ++i) {
      const MeetingPoint& m = met[std::min(i, count - 1)];
      a_[0][i] = m.position.x, a_[1][i] = m.position.y, a_[2][i] = m.position.z;
      a_[3][i] = m.direction.x, a_[4][i] = m.direction.y, a_[5][i] = m.direction.z;
    }
    p = {load(a_[0]), load(a_[1]), load(a_[2])};
    d_ = {load(a_[3]), load(a_[4]), load(a_[5])};
  }
  void find_normals(Sampler& sampler, const FieldData& field) {
    n = surface_normal_at(sampler, field, p, normal_step(p));
    const std::uint32_t away = ~bits(dot(n, d_) < F(0.0f)) & all_lanes;
    if (HWY_LIKELY(away == 0)) return;
    const P before = along(p, d_, normal_step(p) * -4.0f);
    const P there = normal_at(sampler, field, before, normal_step(before));
    const M turned = mask_of(away) & (dot(there, d_) < F(0.0f));
    n = {select(turned, there.x, n.x), select(turned, there.y, n.y), select(turned, there.z, n.z)};
  }
  void put_onto_surface(Sampler& sampler, const FieldData& field, const PointError& error) {
    const F way = max(greatest(p), error.least_size) * (64 * error.roundings);
    const F here = sampler.distance(p, all_lanes, 1e30f);
    const F side = select(here < F(0.0f), -way, way);
    const P aside = along(p, n, side);
    const F rise = abs(sampler.distance(aside, all_lanes, most_after(field, here, way, p)));
    p = along(p, n, -here / clamp((rise - abs(here)) / way, 0.1f, 1.0f));
  }
  void write(Vec3* positions, Vec3* normals) {
    store(p.x, a_[0]), store(p.y, a_[1]), store(p.z, a_[2]);
    store(n.x, a_[3]), store(n.y, a_[4]), store(n.z, a_[5]);
    for (std::size_t i = 0; i < count_; ++i)
      positions[i] = {a_[0][i], a_[1][i], a_[2][i]}, normals[i] = {a_[3][i], a_[4][i], a_[5][i]};
  }

  P p, n;

 private:
  P d_;
  std::size_t count_;
  HWY_ALIGN float a_[6][lanes];
};

}  // namespace penumbra::sdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
