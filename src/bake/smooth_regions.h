// Curved surfaces cut into regions that can be laid flat by projection.
#pragma once

#include "bake/coplanar.h"

namespace penumbra::bake {

/// A region and the unit direction that it is seen along, on its front.
struct SmoothRegion {
  TriangleIds triangles;
  Vec3 axis;
};

/// Parts the given triangles into connected regions whose normals all lie within 60 degrees of the
/// region's axis, the normal of its largest triangle; regions of less than `least_area` (m²) are
/// joined to neighbours whose axis is within 75 degrees of all their normals. Regions may still
/// overlap themselves when they are projected.
std::vector<SmoothRegion> smooth_regions(const WorldMesh& mesh, const Adjacency& adjacency,
                                         const TriangleIds& triangles, float least_area);

}  // namespace penumbra::bake
