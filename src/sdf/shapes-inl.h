// Distances of the shapes (Quilez, "distance functions" in 3-D and 2-D). c: the record's constants,
// the centre first; f < 0 inside. Included once per SIMD target.
#if defined(PENUMBRA_SDF_SHAPES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PENUMBRA_SDF_SHAPES_INL_H
#undef PENUMBRA_SDF_SHAPES_INL_H
#else
#define PENUMBRA_SDF_SHAPES_INL_H
#endif

#include "sdf/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::sdf::HWY_NAMESPACE {

// The corner distance that boxes, cylinders and extrusions share.
HWY_INLINE F corner(const F& x, const F& y) {
  return length(max(x, 0.0f), max(y, 0.0f)) + min(max(x, y), 0.0f);
}

HWY_INLINE F sphere(const P& p, const float* c) {
  const P q = from(p, c);
  return length(q.x, q.y, q.z) - c[3];
}

HWY_INLINE F box(const P& p, const float* c) {
  const P q = from(p, c);
  const F x = abs(q.x) - c[3], y = abs(q.y) - c[4], z = abs(q.z) - c[5];
  return length(max(x, 0.0f), max(y, 0.0f), max(z, 0.0f)) + min(max(x, max(y, z)), 0.0f);
}

HWY_INLINE F round_box(const P& p, const float* c) { return box(p, c) - c[6]; }

/// k₀ (k₀ − 1) / k₁ outside; inside, where that has no bounded slope, (k₀ − 1) times the least
/// radius. c[3..5] = 1 / radii, c[6..8] = their squares, c[9] = the least radius.
HWY_INLINE F ellipsoid(const P& p, const float* c) {
  const P q = from(p, c);
  const F k0 = length(q.x * c[3], q.y * c[4], q.z * c[5]);
  const F k1 = length(q.x * c[6], q.y * c[7], q.z * c[8]);
  const F excess = k0 - 1.0f;
  return select(k0 < F(1.0f), excess * c[9], k0 * excess / max(k1, 1e-30f));
}

HWY_INLINE F torus(const P& p, const float* c) {
  const P q = from(p, c);
  return length(length(q.x, q.z) - c[3], q.y) - c[4];
}

/// c[3..4] = sine and cosine of the aperture, then the radii.
HWY_INLINE F capped_torus(const P& p, const float* c) {
  const P q = from(p, c);
  const F x = abs(q.x);
  const F along = mad(x, c[3], q.y * c[4]), flat = length(x, q.y);
  const F k = select(x * c[4] > q.y * c[3], along, flat);
  const F square = mad(x, x, mad(q.y, q.y, q.z * q.z));
  return sqrt(max(nmad(k, 2 * c[5], square + c[5] * c[5]), 0.0f)) - c[6];
}

/// c = from, to − from, 1 / |to − from|², radius.
HWY_INLINE F capsule(const P& p, const float* c) {
  const P q = from(p, c);
  const F h = clamp(mad(q.x, c[3], mad(q.y, c[4], q.z * c[5])) * c[6], 0.0f, 1.0f);
  return length(nmad(h, c[3], q.x), nmad(h, c[4], q.y), nmad(h, c[5], q.z)) - c[7];
}

/// c[3] = half height, c[4] = radius.
HWY_INLINE F cylinder(const P& p, const float* c) {
  const P q = from(p, c);
  return corner(length(q.x, q.z) - c[4], abs(q.y) - c[3]);
}

/// c[3] = half height h, c[4], c[5] = radii below and above, c[6] = 1 / |(r₂ − r₁, 2h)|².
HWY_INLINE F capped_cone(const P& p, const float* c) {
  const P q = from(p, c);
  const float h = c[3], r1 = c[4], r2 = c[5];
  const F x = length(q.x, q.z);
  const F ax = x - min(x, select(q.y < F(0.0f), r1, r2)), ay = abs(q.y) - h;
  const F s = clamp(mad(F(r2) - x, r2 - r1, (F(h) - q.y) * (2 * h)) * c[6], 0.0f, 1.0f);
  const F bx = mad(s, r2 - r1, x - r2), by = mad(s, 2 * h, q.y - h);
  const F d = sqrt(min(mad(ax, ax, ay * ay), mad(bx, bx, by * by)));
  return select((bx < F(0.0f)) & (ay < F(0.0f)), -d, d);
}

/// c[3], c[4] = radius of the base and height, c[5] = 1 / (c[3]² + c[4]²).
HWY_INLINE F cone(const P& p, const float* c) {
  const P q = from(p, c);
  const float r = c[3], h = c[4];
  const F x = length(q.x, q.z), y = q.y;
  const F s = clamp(mad(x, r, y * -h) * c[5], 0.0f, 1.0f);
  const F ax = nmad(s, r, x), ay = mad(s, h, y);
  const F bx = x - min(x, r), by = y + h;
  const F d = sqrt(min(mad(ax, ax, ay * ay), mad(bx, bx, by * by)));
  const F outside = max(mad(x, h, y * r), -(y + h));
  return select(outside < F(0.0f), -d, d);
}

/// c = normal, offset.
HWY_INLINE F plane(const P& p, const float* c) {
  return mad(p.x, c[0], mad(p.y, c[1], mad(p.z, c[2], F(-c[3]))));
}

/// Along z: c[3] = apothem, c[4] = half height.
HWY_INLINE F hexagonal_prism(const P& p, const float* c) {
  const P q = from(p, c);
  constexpr float kx = -0.866025404f, ky = 0.5f, kz = 0.577350269f;
  F x = abs(q.x), y = abs(q.y);
  const F fold = min(mad(x, kx, y * ky), 0.0f);
  x = nmad(fold, 2 * kx, x);
  y = nmad(fold, 2 * ky, y);
  const F over = y - c[3];
  const F d = copy_sign(length(x - clamp(x, -kz * c[3], kz * c[3]), over), over);
  return corner(d, abs(q.z) - c[4]);
}

HWY_INLINE F octahedron(const P& p, const float* c) {
  const P q = from(p, c);
  const float s = c[3];
  const F x = abs(q.x), y = abs(q.y), z = abs(q.z);
  const F m = x + y + z - s;
  const M in_x = 3.0f * x < m, in_y = 3.0f * y < m, in_z = 3.0f * z < m;
  const F a = select(in_x, x, select(in_y, y, z));
  const F b = select(in_x, y, select(in_y, z, x));
  const F d = select(in_x, z, select(in_y, x, y));
  const F k = clamp(0.5f * (d - b + s), 0.0f, s);
  const F to_edge = length(a, b - s + k, d - k);
  return select(in_x | in_y | in_z, to_edge, m * 0.577350269f);
}

/// Drawn apart along y: c[3] = half length, then the radii.
HWY_INLINE F link(const P& p, const float* c) {
  const P q = from(p, c);
  const F y = max(abs(q.y) - c[3], 0.0f);
  return length(length(q.x, y) - c[4], q.z) - c[5];
}

HWY_INLINE F circle(const F& x, const F& y, const float* c) { return length(x, y) - c[0]; }

HWY_INLINE F rectangle(const F& x, const F& y, const float* c) {
  return corner(abs(x) - c[0], abs(y) - c[1]);
}

/// Quilez, "polygon": c[0] = count of edges; for each its end (x, y), the vector (ex, ey) to the
/// end before, 1 / |e|² and the y of that end. Squared distance, and the mask of points inside
/// (winding parity).
HWY_INLINE F polygon_square(const F& x, const F& y, const float* c, M& inside) {
  const int n = static_cast<int>(c[0]);
  F least = 1e30f;
  inside = F(0.0f) < F(0.0f);
  const float* e = c + 1;
  for (int i = 0; i < n; ++i, e += 6) {
    const F wx = x - e[0], wy = y - e[1];
    const F h = clamp(mad(wx, e[2], wy * e[3]) * e[4], 0.0f, 1.0f);
    const F bx = nmad(h, e[2], wx), by = nmad(h, e[3], wy);
    least = min(least, mad(bx, bx, by * by));
    const M above = y >= F(e[1]), below_other = y < F(e[5]);
    const M left = wy * e[2] < wx * e[3];
    const M upward = and_not(left, above & below_other);
    const M downward = and_not(above | below_other, left);
    inside = inside ^ (upward | downward);
  }
  return least;
}

HWY_INLINE F polygon(const F& x, const F& y, const float* c) {
  M inside;
  const F d = sqrt(polygon_square(x, y, c, inside));
  return select(inside, -d, d);
}

/// A flat polygon in space: c = a point of it, then the rows u, v, n of its frame (u along the
/// first edge, n its normal), then the in-plane polygon.
HWY_INLINE F flat_polygon(const P& p, const float* c) {
  const P q = from(p, c);
  const F x = mad(q.x, c[3], mad(q.y, c[4], q.z * c[5]));
  const F y = mad(q.x, c[6], mad(q.y, c[7], q.z * c[8]));
  const F z = mad(q.x, c[9], mad(q.y, c[10], q.z * c[11]));
  M inside;
  const F square = polygon_square(x, y, c + 12, inside);
  return length(z, sqrt(select(inside, 0.0f, square)));
}

}  // namespace penumbra::sdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
