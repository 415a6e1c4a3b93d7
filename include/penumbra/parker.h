// Single-sample soft shadows: how much of a light is seen past spheres and triangles, from one
// shadow ray and no random number.
//
//   Steven Parker, Peter Shirley, Brian Smits: Single Sample Soft Shadows. University of Utah,
//   1998.
//
// Copy this file into your renderer: it needs nothing but the standard library, allocates nothing,
// and every function is pure and thread-safe. examples/tiny_tracer.cpp shows it at work.
//
// The idea (section 3). The shadow of a soft-edged object under a point light stands in for the
// shadow of the object under an area light. An occluder that passes the shadow ray at distance d,
// measured at distance t along the ray, dims the light where d is less than b = D t / A; D is the
// light's diameter and A its distance. The dimming runs from 0 at the occluder to 1 at b, along a
// profile. The ratio d / t is called clearance here: the same number for a sphere and a triangle, a
// minimum over everything that is in the way, and D / A is its largest value that matters:
//
//   float clearance = ray.diameter_over_distance;
//   for (every sphere)   clearance = std::min(clearance, sphere_clearance(ray, center, radius));
//   for (every triangle) clearance = std::min(clearance, triangle_clearance(ray, a, b, c));
//   float visible_fraction = cubic(tau(ray, clearance));
//
// Known failures: the umbra is too large, for the whole penumbra lies outside the hard shadow; one
// occluder counts where several overlap; an occluder smaller than the light casts a full umbra.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra::parker {

struct Vec {
  float x, y, z;
};

/// From a shaded point to the centre of a light.
struct ShadowRay {
  Vec origin;                    ///< o, the shaded point
  Vec direction;                 ///< v, unit vector to the light's centre
  float distance;                ///< A > 0; infinite for a sun
  float diameter_over_distance;  ///< D / A ≥ 0; a sun: 2 tan(half its angular diameter)
};

/// The points p with dot(normal, p) > offset.
struct HalfSpace {
  Vec normal;
  float offset;
};

/// "Nothing in the way."
inline constexpr float clear = std::numeric_limits<float>::infinity();

namespace detail {

inline Vec sub(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline float dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec mix(Vec a, Vec b, float s) {
  return {a.x + s * (b.x - a.x), a.y + s * (b.y - a.y), a.z + s * (b.z - a.z)};
}

/// Coordinates along and across the ray: z along it, x and y across.
struct RayFrame {
  Vec u, w, v;
  /// The frame of Duff et al. (2017), Building an Orthonormal Basis, Revisited.
  explicit RayFrame(Vec d) : v(d) {
    const float sign = std::copysign(1.0f, d.z), a = -1.0f / (sign + d.z), b = d.x * d.y * a;
    u = {1.0f + sign * d.x * d.x * a, sign * b, -sign * d.x};
    w = {b, sign + d.y * d.y * a, -d.y};
  }
  Vec local(Vec p) const { return {dot(p, u), dot(p, w), dot(p, v)}; }
};

/// Distance from the origin of the projection (x/z, y/z) to the segment between two points, both
/// given before division, z ≥ 0. Divides by z of an end only where that end is nearest.
inline float segment_clearance(Vec a, Vec b) {
  const float nx = a.y * b.z - a.z * b.y, ny = a.z * b.x - a.x * b.z, nz = a.x * b.y - a.y * b.x;
  const float along_a = a.y * nx - a.x * ny, along_b = b.y * nx - b.x * ny;
  const float across = nx * nx + ny * ny;
  if ((along_a < 0) != (along_b < 0) && across > 0) return std::abs(nz) / std::sqrt(across);
  const float da = std::hypot(a.x, a.y), db = std::hypot(b.x, b.y);
  return std::min(a.z > 0 ? da / a.z : clear, b.z > 0 ? db / b.z : clear);
}

/// A convex polygon in ray coordinates, cut by half-spaces.
struct Polygon {
  static constexpr int capacity = 12;
  Vec vertex[capacity];
  int count = 0;

  /// Keeps what has dot(normal, p) > offset (Sutherland and Hodgman 1974).
  void clip(Vec normal, float offset) {
    Polygon kept;
    for (int i = 0; i < count; ++i) {
      const Vec a = vertex[i], b = vertex[(i + 1) % count];
      const float ha = dot(normal, a) - offset, hb = dot(normal, b) - offset;
      if (ha > 0 && kept.count < capacity) kept.vertex[kept.count++] = a;
      if ((ha > 0) != (hb > 0) && kept.count < capacity)
        kept.vertex[kept.count++] = mix(a, b, ha / (ha - hb));
    }
    *this = kept;
  }

  float clearance() const {
    bool left = true, right = true, area = false;
    float least = clear;
    for (int i = 0; i < count; ++i) {
      const Vec a = vertex[i], b = vertex[(i + 1) % count];
      const float side = a.x * b.y - b.x * a.y;
      left = left && side >= 0, right = right && side <= 0, area = area || side != 0;
      least = std::min(least, segment_clearance(a, b));
    }
    return count > 0 && area && (left || right) ? 0 : least;
  }
};

/// A half-plane across the ray: nx x + ny y > offset, (nx, ny) unit.
struct HalfPlane {
  float nx, ny, offset;
  float height(float x, float y) const { return nx * x + ny * y - offset; }
};

/// The part of the chord where `cut` meets the disk that `other` keeps: its distance from (0, 0).
inline float chord_distance(Vec center, float radius, HalfPlane cut, HalfPlane other) {
  const float h = cut.height(center.x, center.y);
  if (h * h > radius * radius) return clear;
  const float fx = center.x - h * cut.nx, fy = center.y - h * cut.ny;
  float hi = std::sqrt(radius * radius - h * h), lo = -hi;
  const float slope = other.ny * cut.nx - other.nx * cut.ny, rest = -other.height(fx, fy);
  if (slope > 0) lo = std::max(lo, rest / slope);
  if (slope < 0) hi = std::min(hi, rest / slope);
  if (lo > hi || (slope == 0 && rest > 0)) return clear;
  const float s = std::clamp(fx * cut.ny - fy * cut.nx, lo, hi);
  return std::hypot(fx - s * cut.ny, fy + s * cut.nx);
}

/// Distance from (0, 0), which both half-planes keep, to the part of a disk that both keep.
inline float disk_distance(Vec center, float radius, HalfPlane a, HalfPlane b) {
  const float d = std::hypot(center.x, center.y), shrink = 1 - radius / d;
  const float x = center.x * shrink, y = center.y * shrink;
  if (a.height(x, y) > 0 && b.height(x, y) > 0) return d - radius;
  return std::min(chord_distance(center, radius, a, b), chord_distance(center, radius, b, a));
}

/// A half-space where it meets the plane across the ray at distance t.
inline HalfPlane slice(const RayFrame& frame, Vec origin, const HalfSpace& space, float t) {
  const Vec n = frame.local(space.normal);
  const float across = std::hypot(n.x, n.y);
  const float offset = space.offset - dot(space.normal, origin) - n.z * t;
  if (across < 1e-12f) return {1, 0, offset < 0 ? -clear : clear};
  return {n.x / across, n.y / across, offset / across};
}

inline constexpr HalfSpace everything{{0, 0, 0}, -1};

}  // namespace detail

/// Clearance of a sphere: (d − R) / t₀ of the Appendix, with t₀ = (c − o) · v and d the distance of
/// the centre from the ray; 0 if the sphere blocks the ray between the point and the light; `clear`
/// if its centre is behind the point. A sphere that reaches beyond the light's distance counts as
/// far as that; of a sphere that crosses `above` (the shaded point's tangent plane, say) or
/// `before` (the plane of a flat light) the part inside counts.
inline float sphere_clearance(const ShadowRay& ray, Vec center, float radius,
                              HalfSpace above = detail::everything,
                              HalfSpace before = detail::everything) {
  const detail::RayFrame frame(ray.direction);
  const Vec c = frame.local(detail::sub(center, ray.origin));
  const float d = std::hypot(c.x, c.y);
  if (d < radius) {
    const float half = std::sqrt(radius * radius - d * d);
    return c.z + half > 0 && c.z - half < ray.distance ? 0 : clear;
  }
  if (c.z <= 0) return clear;
  const float t = std::min(c.z, ray.distance), beyond = c.z - t;
  if (beyond >= radius) return clear;
  const float r = beyond > 0 ? std::sqrt(radius * radius - beyond * beyond) : radius;
  return detail::disk_distance(c, r, detail::slice(frame, ray.origin, above, t),
                               detail::slice(frame, ray.origin, before, t)) /
         t;
}

/// Clearance of a triangle: the least angle's tangent between the ray and any of its points with
/// 0 < t < A; 0 if it blocks the ray. The offset of each side that the Appendix describes, with its
/// factor of the cosine between the normal and v, and the rounded corners are what this distance
/// gives in the plane at unit distance along the ray. Triangles of one flat face leave no seam.
/// `above` and `before` as for spheres.
inline float triangle_clearance(const ShadowRay& ray, Vec a, Vec b, Vec c,
                                HalfSpace above = detail::everything,
                                HalfSpace before = detail::everything) {
  const detail::RayFrame frame(ray.direction);
  detail::Polygon polygon;
  for (const Vec& p : {a, b, c})
    polygon.vertex[polygon.count++] = frame.local(detail::sub(p, ray.origin));
  polygon.clip({0, 0, 1}, 0);
  if (ray.distance < clear) polygon.clip({0, 0, -1}, -ray.distance);
  for (const HalfSpace& space : {above, before})
    polygon.clip(frame.local(space.normal), space.offset - detail::dot(space.normal, ray.origin));
  return polygon.clearance();
}

/// τ in [0, 1]: 0 at the occluder, 1 at the outer edge of the penumbra (Appendix: τ = (d − R) / b).
/// A light without extent has no penumbra: then 0 or 1.
inline float tau(const ShadowRay& ray, float clearance) {
  if (!(clearance > 0)) return 0;
  return clearance < ray.diameter_over_distance ? clearance / ray.diameter_over_distance : 1;
}

/// τ of one sphere, of one triangle.
inline float sphere_tau(const ShadowRay& ray, Vec center, float radius) {
  return tau(ray, sphere_clearance(ray, center, radius));
}
inline float triangle_tau(const ShadowRay& ray, Vec a, Vec b, Vec c) {
  return tau(ray, triangle_clearance(ray, a, b, c));
}

/// Visible fraction from τ in [0, 1]: s = 3τ² − 2τ³ (section 3, the Bernstein interpolant).
constexpr float cubic(float tau) { return tau * tau * (3 - 2 * tau); }
/// s = (1 + sin(πτ − π/2)) / 2 (section 3). Neither this nor the cubic is the exact law of a disk
/// light and a straight edge, which is ½ + (x √(1 − x²) + asin x) / π with x = 2τ − 1.
inline float sine(float tau) { return 0.5f + 0.5f * std::sin(3.14159265f * tau - 1.57079633f); }
constexpr float linear(float tau) { return tau; }

/// Visible fractions of several objects made one (section 3): thresholding, multiplication,
/// addition. Within one object always the minimum.
constexpr float composite_min(float s1, float s2) { return s1 < s2 ? s1 : s2; }
constexpr float composite_multiply(float s1, float s2) { return s1 * s2; }
constexpr float composite_add(float s1, float s2) {
  const float s = 1 - ((1 - s1) + (1 - s2));
  return s > 0 ? s : 0;
}

}  // namespace penumbra::parker
