// Convex polygons cut by planes.
#pragma once

#include <array>

#include "base/vec.h"

namespace penumbra::bake {

/// A convex polygon of a triangle after up to six cuts.
struct ClipPolygon {
  int count = 0;
  std::array<Vec3d, 9> corners;
};

/// Keeps what has value(corner) ≥ 0 (Sutherland and Hodgman 1974, Reentrant Polygon Clipping).
/// `value` is affine. The new corners of an edge do not depend on the side it is seen from, so that
/// neighbours stay neighbours.
template <class Value>
void clip(ClipPolygon& polygon, const Value& value) {
  ClipPolygon out;
  for (int i = 0; i < polygon.count; ++i) {
    const Vec3d& a = polygon.corners[i];
    const Vec3d& b = polygon.corners[i + 1 < polygon.count ? i + 1 : 0];
    const double at_a = value(a), at_b = value(b);
    if (at_a >= 0) out.corners[out.count++] = a;
    if ((at_a >= 0) == (at_b >= 0)) continue;
    const bool a_stays = at_a >= 0;
    const Vec3d &kept = a_stays ? a : b, &lost = a_stays ? b : a;
    const double from = a_stays ? at_a : at_b, to = a_stays ? at_b : at_a;
    out.corners[out.count++] = kept + (lost - kept) * (from / (from - to));
  }
  polygon = out;
}

}  // namespace penumbra::bake
