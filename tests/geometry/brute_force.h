// The least clearance by looking at every primitive, in double precision and with projected
// coordinates divided out: slow, and written apart from the code that it judges.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/cone_tree.h"

namespace penumbra::testing {

using Polygon = std::vector<Vec3d>;

inline Polygon clip(const Polygon& in, const Vec3d& n, double offset) {
  Polygon out;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Vec3d &a = in[i], &b = in[(i + 1) % in.size()];
    const double ha = dot(n, a) - offset, hb = dot(n, b) - offset;
    if (ha > 0) out.push_back(a);
    if ((ha > 0) != (hb > 0)) out.push_back(a + (b - a) * (ha / (ha - hb)));
  }
  return out;
}

inline double polygon_clearance(const Polygon& world, const ConeQuery& q) {
  const Vec3d o(q.origin), v(q.direction), n(q.horizon), m(q.plane_normal);
  Polygon p;
  for (const Vec3d& a : world) p.push_back(a - o);
  p = clip(p, v, 1e-9);
  if (std::isfinite(q.distance)) p = clip(p, -v, -double{q.distance});
  p = clip(p, n, q.epsilon);
  if (q.has_plane) p = clip(p, m, double{q.plane_epsilon} - q.plane_distance);
  if (p.empty()) return INFINITY;
  const Vec3d u = normalize(cross(v, std::abs(v.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}));
  const Vec3d w = cross(v, u);
  double least = INFINITY;
  bool left = true, right = true;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto flat = [&](const Vec3d& a) {
      return std::array{dot(a, u) / dot(a, v), dot(a, w) / dot(a, v)};
    };
    const auto a = flat(p[i]), b = flat(p[(i + 1) % p.size()]);
    const double dx = b[0] - a[0], dy = b[1] - a[1], dd = dx * dx + dy * dy;
    const double s = dd > 0 ? std::clamp(-(a[0] * dx + a[1] * dy) / dd, 0.0, 1.0) : 0;
    least = std::min(least, std::hypot(a[0] + s * dx, a[1] + s * dy));
    const double side = a[0] * b[1] - b[0] * a[1];
    left = left && side >= 0, right = right && side <= 0;
  }
  return left || right ? 0 : least;
}

/// Spheres wholly above the horizon and short of the light: the paper's Appendix.
inline double sphere_clearance(const Vec3d& center, double radius, const ConeQuery& q) {
  const Vec3d c = center - Vec3d(q.origin), v(q.direction);
  const double t0 = dot(c, v), d = length(c - v * t0);
  if (t0 < 0) return INFINITY;
  return d < radius ? 0 : (d - radius) / t0;
}

}  // namespace penumbra::testing
