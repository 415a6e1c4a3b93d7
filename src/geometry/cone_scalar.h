// The few occluders that the SIMD leaves pass on, one by one. Private to the geometry room.
#pragma once

#include "geometry/cone_tree_data.h"
#include "geometry/local_query.h"

namespace penumbra {

/// Clearance of one lane, cut by everything that limits what counts; infinite if nothing is left.
float scalar_triangle(const TriangleLeaf& leaf, std::size_t lane, const LocalQuery& q);
float scalar_sphere(const SphereLeaf& leaf, std::size_t lane, const LocalQuery& q);

/// Clearance of the opaque part of a cut-out triangle: of its nearest point, and from there as far
/// as the texture's distance field says. Exact where the nearest point is opaque or the ray passes
/// through a hole whose nearest edge lies across the ray.
float cut_out_clearance(const ConeTree::Data& data, const CutOut& cut, const LocalQuery& q);

}  // namespace penumbra
