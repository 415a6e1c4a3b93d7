// A cone query in the frame of one tree, and the slabs of its cone. Private to the geometry room.
#pragma once

#include <hwy/base.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/cone_tree.h"

namespace penumbra {

struct LocalQuery {
  Vec3 origin;
  Frame ray;        ///< w along the ray
  Vec3 sine;        ///< of the angle between the ray and each axis
  float t_max = 0;  ///< to the light; infinite for a sun
  float reach = 0;  ///< the same, finite: no box of the tree is further
  Vec3 horizon;
  float epsilon = 0;  ///< height above the horizon that is still on it
  float rise = 0;     ///< height gained per distance along the ray
  bool has_plane = false;
  Vec3 plane_normal;
  float plane_distance = 0, plane_epsilon = 0;
  bool lower_bound = false;

  /// `bounds`: of everything in the tree.
  HWY_INLINE LocalQuery(const ConeQuery& q, const Bounds& bounds)
      : origin(q.origin),
        ray(frame_around(q.direction)),
        t_max(q.distance),
        horizon(q.horizon),
        epsilon(q.epsilon),
        rise(dot(q.horizon, q.direction)),
        has_plane(q.has_plane),
        plane_normal(q.plane_normal),
        plane_distance(q.plane_distance),
        plane_epsilon(q.plane_epsilon),
        lower_bound(q.lower_bound) {
    const Vec3 v = q.direction;
    for (int i = 0; i < 3; ++i) sine[i] = std::sqrt(std::max(0.0f, 1 - v[i] * v[i]));
    const float furthest = 2 * (length(bounds.center() - origin) + bounds.diagonal());
    reach = std::min(t_max, furthest);
  }
};

/// The cone's extent as bounds on t. For axis i and half-angle tangent k with K = k sine_i a point
/// at distance t along the axis is within the cone's disk only if t (v + K) ≥ lo and
/// t (v − K) ≤ hi, all relative to the origin. Which of them bounds t from below depends on signs
/// that depend on k: renewed when k shrinks.
struct ConeSlabs {
  float inv_lo[3], inv_hi[3];
  bool lo_is_near[3], hi_is_far[3];

  ConeSlabs() = default;
  HWY_INLINE ConeSlabs(const LocalQuery& q, float k) {
    for (int i = 0; i < 3; ++i) {
      const float v = q.ray.w[i], reach = k * q.sine[i];
      inv_lo[i] = reciprocal(v + reach), inv_hi[i] = reciprocal(v - reach);
      lo_is_near[i] = inv_lo[i] > 0, hi_is_far[i] = inv_hi[i] > 0;
    }
  }

 private:
  // A slab parallel to the cone's side bounds nothing or everything; a huge number does both.
  static float reciprocal(float x) { return std::abs(x) < 1e-18f ? 1e18f : 1 / x; }
};

}  // namespace penumbra
