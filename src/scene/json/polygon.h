// Polygons in space, cut into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/vec.h"

namespace penumbra::json {

struct PolygonCut {
  std::vector<std::uint32_t> indices;  ///< count − 2 triangles, none without area
  Vec3d normal;                        ///< unit; the vertices run counter-clockwise around it
  std::string fault, remedy;           ///< if it cannot be cut: what is wrong, what to do
};

/// Cuts a simple polygon, convex or concave, of 3 to 1000 vertices by clipping ears (Meisters 1975,
/// Polygons have ears), in O(n²). Every vertex is kept, also one in the middle of a straight edge.
/// A fault: edges that meet elsewhere than at their common vertex, no area, or a vertex further
/// from the polygon's plane than a thousandth of its size.
PolygonCut cut_polygon(std::span<const Vec3d> vertices);

}  // namespace penumbra::json
