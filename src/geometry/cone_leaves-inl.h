// Leaves against one cone: exact clearances, eight at a time. Included once per SIMD target.
#if defined(PENUMBRA_CONE_LEAVES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_CONE_LEAVES_INL_H
#undef PENUMBRA_CONE_LEAVES_INL_H
#else
#define PENUMBRA_CONE_LEAVES_INL_H
#endif

#include "geometry/cone_scalar.h"
#include "geometry/cone_simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::HWY_NAMESPACE {

/// Clearances of a leaf's lanes; infinite where a lane is out of the way.
struct LeafClearance {
  HWY_ALIGN float lane[tree_width];
  float least = infinite;
};

/// Eight triangles in ray coordinates, with their corners' heights.
struct Corners {
  Point p[3];
  Floats above[3];   ///< over the horizon
  Floats before[3];  ///< a flat light's plane
};

HWY_INLINE Floats min3(const Floats* a) { return hn::Min(hn::Min(a[0], a[1]), a[2]); }
HWY_INLINE Floats max3(const Floats* a) { return hn::Max(hn::Max(a[0], a[1]), a[2]); }

/// Loads the corners; false if none of the triangles has a part above the horizon.
HWY_INLINE bool load_corners(const TriangleLeaf& leaf, std::size_t first, const LocalQuery& q,
                             Corners& c) {
  const Lanes d;
  for (int v = 0; v < 3; ++v) {
    const Point p{hn::Sub(hn::Load(d, leaf.position[v][0] + first), all(q.origin.x)),
                  hn::Sub(hn::Load(d, leaf.position[v][1] + first), all(q.origin.y)),
                  hn::Sub(hn::Load(d, leaf.position[v][2] + first), all(q.origin.z))};
    c.p[v] = p;
    c.above[v] = hn::Sub(dot(q.horizon, p), all(q.epsilon));
  }
  if (hn::AllFalse(d, hn::Gt(max3(c.above), hn::Zero(d)))) return false;
  for (int v = 0; v < 3; ++v) {
    const Point p = c.p[v];
    c.p[v] = {dot(q.ray.u, p), dot(q.ray.v, p), dot(q.ray.w, p)};
    c.before[v] = q.has_plane
                      ? hn::Add(dot(q.plane_normal, p), all(q.plane_distance - q.plane_epsilon))
                      : all(1);
  }
  return true;
}

/// Lanes whose triangle the ray meets between the point and the light, above the horizon.
HWY_INLINE Bools blocked(const Corners& c, const LocalQuery& q) {
  const Floats zero = hn::Zero(Lanes());
  Floats side[3], sum = zero, along = zero;
  for (int v = 0; v < 3; ++v) {
    const Point &a = c.p[(v + 1) % 3], &b = c.p[(v + 2) % 3];
    side[v] = hn::MulSub(a.x, b.y, hn::Mul(b.x, a.y));
    sum = hn::Add(sum, side[v]);
    along = hn::MulAdd(side[v], c.p[v].z, along);
  }
  const Bools inside = hn::Or(hn::Ge(min3(side), zero), hn::Le(max3(side), zero));
  const Floats t = hn::Div(along, sum);  // not a number where all sides are zero: then no hit
  return hn::And(hn::And(inside, hn::Gt(hn::Mul(t, all(q.rise)), all(q.epsilon))),
                 hn::And(hn::Lt(t, all(q.t_max)), hn::Gt(t, zero)));
}

/// Lanes whose triangle lies beyond one of eight planes that touch the cone of radius
/// slope · z + offset.
HWY_INLINE Bools beside_cone(const Point* p, float slope, float offset) {
  const Floats zero = hn::Zero(Lanes());
  Floats x[3], y[3], k[3], sum[3], difference[3], wide[3];
  for (int v = 0; v < 3; ++v) {
    x[v] = p[v].x, y[v] = p[v].y, k[v] = hn::MulAdd(all(slope), p[v].z, all(offset));
    sum[v] = hn::Add(x[v], y[v]), difference[v] = hn::Sub(x[v], y[v]);
    wide[v] = hn::Mul(all(1.41421356f), k[v]);
  }
  const auto beyond = [&](const Floats* a, const Floats* reach) {
    const Floats above[3] = {hn::Sub(a[0], reach[0]), hn::Sub(a[1], reach[1]),
                             hn::Sub(a[2], reach[2])};
    const Floats below[3] = {hn::Add(a[0], reach[0]), hn::Add(a[1], reach[1]),
                             hn::Add(a[2], reach[2])};
    return hn::Or(hn::Gt(min3(above), zero), hn::Lt(max3(below), zero));
  };
  return hn::Or(hn::Or(beyond(x, k), beyond(y, k)),
                hn::Or(beyond(sum, wide), beyond(difference, wide)));
}

/// Squared clearance of triangles that lie wholly in the space that counts.
HWY_INLINE Floats whole_clearance2(const Corners& c) {
  Floats least =
      hn::Min(hn::Min(end_clearance2(c.p[0]), end_clearance2(c.p[1])), end_clearance2(c.p[2]));
  for (int v = 0; v < 3; ++v) least = hn::Min(least, side_clearance2(c.p[v], c.p[(v + 1) % 3]));
  return least;
}

/// Squared clearance of the part of a segment with z > 0.
HWY_INLINE Floats forward_clearance2(const Point& a, const Point& b) {
  const Floats zero = hn::Zero(Lanes());
  const Bools a_in = hn::Gt(a.z, zero), b_in = hn::Gt(b.z, zero);
  Point cut = lerp(a, b, hn::Div(a.z, hn::Sub(a.z, b.z)));
  cut.z = zero;  // at infinity: its direction is all that counts
  const Point from = select(a_in, a, cut), to = select(b_in, b, cut);
  const Floats least =
      hn::Min(side_clearance2(from, to), hn::Min(end_clearance2(from), end_clearance2(to)));
  return hn::IfThenElse(hn::Or(a_in, b_in), least, all(infinite));
}

/// Squared clearance of triangles that cross the horizon or the plane through the point across the
/// ray: their sides as far as they count, and the line that the horizon cuts.
HWY_INLINE Floats cut_clearance2(const Corners& c) {
  const Floats zero = hn::Zero(Lanes());
  Floats least = all(infinite);
  Point cut[3];
  Bools crosses[3];
  for (int v = 0; v < 3; ++v) {
    const int w = (v + 1) % 3;
    const Bools v_in = hn::Gt(c.above[v], zero), w_in = hn::Gt(c.above[w], zero);
    crosses[v] = hn::Xor(v_in, w_in);
    cut[v] = lerp(c.p[v], c.p[w], hn::Div(c.above[v], hn::Sub(c.above[v], c.above[w])));
    const Floats side =
        forward_clearance2(select(v_in, c.p[v], cut[v]), select(w_in, c.p[w], cut[v]));
    least = hn::IfThenElse(hn::Or(v_in, w_in), hn::Min(least, side), least);
  }
  const Floats rim =
      forward_clearance2(select(crosses[0], cut[0], cut[1]), select(crosses[2], cut[2], cut[1]));
  return hn::IfThenElse(hn::Or(crosses[0], crosses[1]), hn::Min(least, rim), least);
}

HWY_INLINE void triangle_lanes(const TriangleLeaf& leaf, const LocalQuery& q, float limit,
                               LeafClearance& out) {
  const Lanes d;
  const Floats zero = hn::Zero(d);
  for (std::size_t first = 0; first < tree_width; first += hn::Lanes(d)) {
    Corners c;
    if (!load_corners(leaf, first, q, c)) {
      hn::Store(all(infinite), d, out.lane + first);
      continue;
    }
    const Floats z[3] = {c.p[0].z, c.p[1].z, c.p[2].z};
    const Floats z_least = min3(z), z_most = max3(z), low = min3(c.above);
    Bools counts = hn::And(hn::And(hn::Gt(max3(c.above), zero), hn::Gt(z_most, zero)),
                           hn::And(hn::Lt(z_least, all(q.t_max)), hn::Gt(max3(c.before), zero)));
    counts = hn::AndNot(beside_cone(c.p, limit, 0), counts);
    if (hn::AllFalse(d, counts)) {
      hn::Store(all(infinite), d, out.lane + first);
      continue;
    }
    const Bools forward = hn::And(hn::Gt(low, zero), hn::Gt(z_least, zero));
    const Bools short_of_light =
        hn::And(hn::Lt(z_most, all(q.t_max)), hn::Gt(min3(c.before), zero));
    Floats least = whole_clearance2(c);
    if (!hn::AllFalse(d, hn::AndNot(forward, counts)))
      least = hn::IfThenElse(forward, least, cut_clearance2(c));
    least = hn::IfThenElse(blocked(c, q), zero, least);
    least = hn::IfThenElse(counts, least, all(infinite));
    hn::Store(hn::Sqrt(least), d, out.lane + first);
    // Triangles that reach past the light are few: one by one, if cutting them can matter.
    const Bools near = hn::Lt(least, all(limit * limit));
    std::uint32_t rest = bits_of(hn::And(near, hn::AndNot(short_of_light, counts)));
    for (; rest; rest &= rest - 1) {
      const auto lane = first + static_cast<std::size_t>(std::countr_zero(rest));
      out.lane[lane] = scalar_triangle(leaf, lane, q);
    }
  }
}

/// Whether any triangle of the leaf may matter to any cone of a bundle, above any of the shaft's
/// horizons.
HWY_INLINE bool leaf_in(const TriangleLeaf& leaf, const ConeShaft& shaft,
                        const ConeBundle& bundle) {
  const Lanes d;
  const float* center = &shaft.center.x;
  const float *normal_lo = &shaft.normal_lo.x, *normal_hi = &shaft.normal_hi.x;
  for (std::size_t first = 0; first < tree_width; first += hn::Lanes(d)) {
    Point p[3];
    Floats z[3], height[3];
    for (int v = 0; v < 3; ++v) {
      Floats from[3];
      height[v] = all(shaft.lift);
      for (int axis = 0; axis < 3; ++axis) {
        from[axis] = hn::Sub(hn::Load(d, leaf.position[v][axis] + first), all(center[axis]));
        height[v] = hn::Add(height[v], hn::Max(hn::Mul(all(normal_lo[axis]), from[axis]),
                                               hn::Mul(all(normal_hi[axis]), from[axis])));
      }
      const Point at{from[0], from[1], from[2]};
      p[v] = {dot(bundle.axis.u, at), dot(bundle.axis.v, at), dot(bundle.axis.w, at)};
      z[v] = p[v].z;
    }
    const Bools high =
        hn::And(hn::Gt(max3(height), all(shaft.epsilon)), hn::Ge(max3(z), all(-bundle.radius)));
    if (!hn::AllFalse(d, hn::AndNot(beside_cone(p, bundle.slope, bundle.offset), high)))
      return true;
  }
  return false;
}

/// Tangents of the angles between the ray and the nearest tangents from the origin to whole
/// spheres, of those that reach over the horizon and before the light: sin and cos of the
/// difference between the angle to the centre and the sphere's half angle, times its distance
/// squared.
HWY_NOINLINE void tangent_clearance(const Point& c, Floats r, const LocalQuery& q, float* out) {
  const Floats zero = hn::Zero(Lanes());
  const Floats x = dot(q.ray.u, c), y = dot(q.ray.v, c), z = dot(q.ray.w, c);
  const Floats away2 = hn::MulAdd(x, x, hn::Mul(y, y)), away = hn::Sqrt(away2);
  const Floats tangent2 = hn::Sub(hn::MulAdd(z, z, away2), hn::Mul(r, r));
  const Floats tangent = hn::Sqrt(hn::Max(tangent2, zero));
  const Floats sine = hn::MulSub(away, tangent, hn::Mul(z, r));
  const Floats cosine = hn::MulAdd(z, tangent, hn::Mul(away, r));
  Floats least = hn::IfThenElse(hn::Gt(cosine, zero), hn::Div(sine, cosine), all(infinite));
  least = hn::IfThenElse(hn::And(hn::Gt(sine, zero), hn::Gt(tangent2, zero)), least, zero);
  Bools counts = hn::And(hn::Gt(hn::Add(dot(q.horizon, c), r), all(q.epsilon)),
                         hn::Lt(hn::Sub(z, r), all(q.t_max)));
  if (q.has_plane) {
    const Floats before = hn::Add(dot(q.plane_normal, c), all(q.plane_distance - q.plane_epsilon));
    counts = hn::And(counts, hn::Gt(hn::Add(before, r), zero));
  }
  hn::Store(hn::IfThenElse(counts, least, all(infinite)), Lanes(), out);
}

HWY_INLINE void sphere_lanes(const SphereLeaf& leaf, const LocalQuery& q, float limit,
                             LeafClearance& out) {
  const Lanes d;
  const Floats zero = hn::Zero(d);
  for (std::size_t first = 0; first < tree_width; first += hn::Lanes(d)) {
    const Point c{hn::Sub(hn::Load(d, leaf.center[0] + first), all(q.origin.x)),
                  hn::Sub(hn::Load(d, leaf.center[1] + first), all(q.origin.y)),
                  hn::Sub(hn::Load(d, leaf.center[2] + first), all(q.origin.z))};
    const Floats r = hn::Load(d, leaf.radius + first);
    if (q.lower_bound) {
      tangent_clearance(c, r, q, out.lane + first);
      continue;
    }
    const Floats x = dot(q.ray.u, c), y = dot(q.ray.v, c), z = dot(q.ray.w, c);
    const Floats away2 = hn::MulAdd(x, x, hn::Mul(y, y)), away = hn::Sqrt(away2);
    const Floats height = hn::Sub(dot(q.horizon, c), all(q.epsilon));
    const Bools counts = hn::Gt(hn::Add(height, r), zero);
    const Floats half = hn::Sqrt(hn::Max(hn::MulSub(r, r, away2), zero));
    const Bools hit = hn::And(
        hn::Lt(away, r), hn::And(hn::Gt(hn::Mul(hn::Add(z, half), all(q.rise)), all(q.epsilon)),
                                 hn::Lt(hn::Sub(z, half), all(q.t_max))));
    const Bools passed = hn::And(hn::Ge(away, r), hn::Gt(z, zero));
    Floats least = hn::IfThenElse(passed, hn::Div(hn::Sub(away, r), z), all(infinite));
    least = hn::IfThenElse(hit, zero, least);
    hn::Store(hn::IfThenElse(counts, least, all(infinite)), d, out.lane + first);
    // Whose nearest point, at the foot's distance, is below the horizon or not short of the light?
    const Floats toward = hn::Div(r, hn::Max(away, all(1e-30f)));
    const auto nearest_height = [&](const Vec3& n, Floats center_height) {
      const Floats lean = hn::MulAdd(x, all(dot(n, q.ray.u)), hn::Mul(y, all(dot(n, q.ray.v))));
      return hn::NegMulAdd(toward, lean, center_height);
    };
    Bools plain = hn::And(hn::Gt(nearest_height(q.horizon, height), zero), hn::Le(z, all(q.t_max)));
    if (q.has_plane) {
      const Floats before =
          hn::Add(dot(q.plane_normal, c), all(q.plane_distance - q.plane_epsilon));
      plain = hn::And(plain, hn::Gt(nearest_height(q.plane_normal, before), zero));
    }
    const Bools near = hn::Lt(least, all(limit));
    std::uint32_t rest = bits_of(hn::And(hn::And(counts, near), hn::AndNot(plain, passed)));
    for (; rest; rest &= rest - 1) {
      const auto lane = first + static_cast<std::size_t>(std::countr_zero(rest));
      out.lane[lane] = scalar_sphere(leaf, lane, q);
    }
  }
}

HWY_INLINE float least_of(const LeafClearance& leaf) {
  const Lanes d;
  Floats least = hn::Load(d, leaf.lane);
  for (std::size_t first = hn::Lanes(d); first < tree_width; first += hn::Lanes(d))
    least = hn::Min(least, hn::Load(d, leaf.lane + first));
  return hn::GetLane(hn::MinOfLanes(d, least));
}

}  // namespace penumbra::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
