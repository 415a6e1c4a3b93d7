// Polygons into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace penumbra {

/// Cuts a simple polygon, convex or concave, nearly planar, into n − 2 triangles of the same
/// winding and appends their corners (numbers into `polygon`) to `triangles`; nothing for n < 3.
///
/// Convex: a fan around the first corner. Concave: ears are clipped (Meisters 1975, Polygons have
/// ears) in the projection along the dominant axis of the polygon's normal (Newell's method), in
/// O(n²) steps. Polygons that cross themselves, and concave ones of more than some thousand reflex
/// corners, end in a fan: time and result stay bounded, the shape may be wrong.
void triangulate(std::span<const Vec3> polygon, std::vector<std::uint32_t>& triangles);

}  // namespace penumbra
