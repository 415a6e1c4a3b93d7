// The published marches in double precision, over the oracle's spheres, boxes and floors.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <variant>

#include "shadow/oracle.h"

namespace penumbra::testing {

using Field = std::function<double(const Vec3d&)>;

inline double box_distance(const Vec3d& p, const Vec3d& lo, const Vec3d& hi) {
  const Vec3d q = abs(p - (lo + hi) * 0.5) - (hi - lo) * 0.5;
  return length(max(q, Vec3d(0.0))) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

// Spheres, boxes and the oracle's axis-parallel floors.
inline double distance(const Scene& scene, const Vec3d& p) {
  double d = INFINITY;
  for (const Sphere& s : scene.spheres) d = std::min(d, length(p - Vec3d(s.center)) - s.radius);
  for (const Mesh& mesh : scene.meshes) {
    if (const auto* box = std::get_if<ExactBox>(&mesh.exact))
      d = std::min(d, box_distance(p, Vec3d(box->lo), Vec3d(box->hi)));
    if (const auto* quad = std::get_if<ExactQuad>(&mesh.exact)) {
      const Vec3d a(quad->corner), b(quad->corner + quad->edge_u + quad->edge_v);
      d = std::min(d, box_distance(p, min(a, b), max(a, b)));
    }
  }
  return d;
}

struct March {
  Vec3d origin, direction;
  double mint, maxt, w;
};

inline double classic(const Field& map, const March& m, bool blog) {
  double res = 1, t = m.mint;
  for (int i = 0; i < 256 && t < (blog ? std::min(m.maxt, 150.0) : m.maxt); ++i) {
    const double h = map(m.origin + m.direction * t);
    if (h < (blog ? 0.0001 : 0.001)) return 0;
    if (blog) t += h;
    res = std::min(res, h / (m.w * t));
    if (!blog) t += h;
  }
  return res;
}

inline double improved(const Field& map, const March& m) {
  double res = 1, ph = 1e20, t = m.mint;
  for (int i = 0; i < 256 && t < m.maxt; ++i) {
    const double h = map(m.origin + m.direction * t);
    if (h < 0.001) return 0;
    const double y = h * h / (2 * ph), d = std::sqrt(h * h - y * y);
    const double ratio = d / (m.w * std::max(0.0, t - y));
    if (!std::isnan(ratio)) res = std::min(res, ratio);
    ph = h;
    t += h;
  }
  return res;
}

inline double inner(const Field& map, const March& m, bool absolute) {
  double res = 1, t = m.mint;
  for (int i = 0; i < 256 && t < m.maxt; ++i) {
    const double h = map(m.origin + m.direction * t);
    res = std::min(res, h / (m.w * t));
    t += absolute ? std::abs(h) : std::clamp(h, 0.005, 0.5);
    if (res < -1 || t > m.maxt) break;
  }
  res = std::max(res, -1.0);
  return 0.25 * (1 + res) * (1 + res) * (2 - res);
}

// Where a ray leaves the scene's bounds enlarged by their diagonal.
inline double way_out(const Scene& scene, const Vec3d& o, const Vec3d& d) {
  const Bounds box = bounds_of(scene);
  const Vec3d grow(static_cast<double>(box.diagonal()));
  const Vec3d lo = Vec3d(box.lo) - grow, hi = Vec3d(box.hi) + grow;
  double t = INFINITY;
  for (int i = 0; i < 3; ++i)
    if (d[i] != 0) t = std::min(t, ((d[i] > 0 ? hi[i] : lo[i]) - o[i]) / d[i]);
  return t;
}

inline double formula(const Scene& scene, const ShadowOptions& o, const OraclePoint& p) {
  const auto view = *LightViews(scene).view(p.light, p.receiver.position);
  March m{Vec3d(p.receiver.position), Vec3d(view.direction), 0.01, view.distance,
          0.5 * view.diameter_over_distance};
  if (std::isinf(m.maxt)) m.maxt = way_out(scene, m.origin, m.direction);
  if (o.k) m.w = 1 / *o.k;
  const Field map = [&](const Vec3d& q) { return distance(scene, q); };
  if (o.kind == ShadowKind::sdf_improved) return improved(map, m);
  if (o.kind == ShadowKind::sdf_inner) return inner(map, m, o.variant == SdfVariant::abs);
  return classic(map, m, o.variant == SdfVariant::blog);
}

}  // namespace penumbra::testing
