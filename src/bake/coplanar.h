// Connected coplanar triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/adjacency.h"

namespace penumbra::bake {

using TriangleIds = std::vector<std::uint32_t>;

/// Parts the flat shaded triangles of a mesh (WorldMesh::is_smooth is false) into connected ones
/// that lie in one plane and face the same way. Each part begins with its largest triangle, whose
/// plane it is: corners are within 1e-5 of the mesh's extent from it, or within eight roundings of
/// their coordinates, and normals within 5 degrees.
std::vector<TriangleIds> coplanar_parts(const WorldMesh& mesh, const Adjacency& adjacency);

}  // namespace penumbra::bake
