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
  std::array<double, 9> at;
  int kept_count = 0;
  for (int i = 0; i < polygon.count; ++i) {
    at[i] = value(polygon.corners[i]);
    kept_count += at[i] >= 0;
  }
  if (kept_count == polygon.count) return;
  if (kept_count == 0) {
    polygon.count = 0;
    return;
  }
  ClipPolygon out;
  for (int i = 0; i < polygon.count; ++i) {
    const int next = i + 1 < polygon.count ? i + 1 : 0;
    const bool stays = at[i] >= 0;
    if (stays) out.corners[out.count++] = polygon.corners[i];
    if (stays == (at[next] >= 0)) continue;
    const int kept = stays ? i : next, lost = stays ? next : i;
    out.corners[out.count++] =
        polygon.corners[kept] +
        (polygon.corners[lost] - polygon.corners[kept]) * (at[kept] / (at[kept] - at[lost]));
  }
  polygon = out;
}

}  // namespace penumbra::bake
