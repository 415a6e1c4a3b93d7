// Faces around a surface, by OpenVDB. Internal to the room.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "sdf/mesher.h"

namespace penumbra::sdf {

/// Quads, or triangles whose last corner repeats the third.
struct SurfaceNet {
  std::vector<Vec3> vertices;  ///< within a voxel of the surface
  std::vector<std::array<std::uint32_t, 4>> faces;
};

/// Throws GridTooLarge (distance_levels.h), Cancelled.
SurfaceNet surface_net(const DistanceFunction& f, const Bounds& bounds, float voxel,
                       std::size_t most_bytes);

}  // namespace penumbra::sdf
