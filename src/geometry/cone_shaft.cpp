#include "geometry/cone_shaft.h"

#include <algorithm>
#include <cmath>

namespace penumbra {
namespace {

// A face parallel to the axis bounds nothing or everything; a huge number does both.
float reciprocal(float x) { return std::abs(x) < 1e-18f ? 1e18f : 1 / x; }

}  // namespace

Bounds cone_end(const ConeQuery& query) {
  const Vec3& v = query.direction;
  const auto sine = [](float c) { return std::sqrt(std::max(0.0f, 1 - c * c)); };
  const Vec3 spread = Vec3{sine(v.x), sine(v.y), sine(v.z)} * query.outer;
  if (std::isinf(query.distance)) return {v - spread, v + spread};
  const float t = query.distance;
  return {query.origin + (v - spread) * t, query.origin + (v + spread) * t};
}

ConeShaft::ConeShaft(std::span<const ConeQuery> queries, std::span<const Bounds> ends,
                     const Bounds& bounds) {
  const bool endless = std::isinf(queries.front().distance);
  Bounds from, to, normals;
  epsilon = INFINITY;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    from.grow(queries[i].origin), to.grow(ends[i]), normals.grow(queries[i].horizon);
    epsilon = std::min(epsilon, queries[i].epsilon);
  }
  // Half of it: what sums round away must not hide what a single query would see.
  epsilon /= 2;
  center = from.center(), normal_lo = normals.lo, normal_hi = normals.hi;
  lift = -INFINITY;
  for (const ConeQuery& q : queries) lift = std::max(lift, dot(q.horizon, center - q.origin));
  // Wider by some roundings of the sums above.
  const auto slack = [](const Bounds& b) {
    return Vec3(0x1p-20f * std::max(max_component(abs(b.lo)), max_component(abs(b.hi))));
  };
  from_lo = from.lo - slack(from), from_hi = from.hi + slack(from);
  Vec3 lower = to.lo - slack(to), upper = to.hi + slack(to);
  if (endless)
    reach = 2 * (length(bounds.center() - center) + bounds.diagonal() + from.diagonal());
  else
    lower = lower - from_lo, upper = upper - from_hi;
  for (int i = 0; i < 3; ++i) {
    inv_lo[i] = reciprocal(upper[i]), inv_hi[i] = reciprocal(lower[i]);
    lo_is_near[i] = inv_lo[i] > 0, hi_is_far[i] = inv_hi[i] > 0;
  }
}

ConeBundle::ConeBundle(std::span<const ConeQuery> queries, const Vec3& center) {
  Vec3 sum;
  for (const ConeQuery& q : queries) {
    sum += q.direction;
    radius = std::max(radius, length(q.origin - center));
  }
  const float total = length(sum);
  if (!(total > 0)) return;
  axis = frame_around(sum / total);
  for (const ConeQuery& q : queries) {
    const float away = length(cross(q.direction, axis.w)), along = dot(q.direction, axis.w);
    // tan(a + b), b the cone's own half-angle.
    const float below = along - away * q.outer;
    if (!(below > 0.1f)) return;
    slope = std::max(slope, (away + along * q.outer) / below);
  }
  // Wider by some roundings.
  slope *= 1 + 0x1p-18f, radius *= 1 + 0x1p-18f;
  offset = radius * std::sqrt(1 + slope * slope);
  valid = true;
}

}  // namespace penumbra
