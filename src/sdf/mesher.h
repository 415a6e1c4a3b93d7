// From distance fields to triangles.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace penumbra::sdf {

class Field;

/// f at points, negative inside, nowhere farther from 0 than the way to the surface.
using DistanceFunction = std::function<void(std::span<const Vec3>, std::span<float>)>;

struct MesherOptions {
  std::optional<double> voxel_size{};  ///< metres; unset = 1/128 of the longest side of the bounds
  std::size_t most_bytes = std::size_t{1} << 30;
};

/// The surface of {f < 0} within `bounds`, closed by their sides where they cut it; triangles face
/// outwards. OpenVDB joins a vertex of each cell that the surface passes (tools::VolumeToMesh);
/// each then goes to the point that lies best on the tangent planes at the middles of its faces
/// (dual/primal optimization, Ohtake and Belyaev 2002, with the quadric of Ju et al. 2002), which
/// keeps edges and corners, and from there onto the surface to 1e-4 of a voxel. Parts thinner than
/// a voxel may be missed. Throws InputError where the grid would take more than most_bytes and
/// where the bounds are empty or not finite, and Cancelled.
Mesh mesh_of_field(const DistanceFunction& f, const Bounds& bounds,
                   const MesherOptions& options = {});

struct FieldMesh {
  Mesh mesh;
  std::uint32_t object, material;
};

/// The same of all that is in `field`, a mesh for each pair of object and material; where materials
/// blend, the heaviest. Without `clip` (--bounds) the field must be bounded: InputError.
std::vector<FieldMesh> meshes_of_field(const Field& field, const std::optional<Bounds>& clip,
                                       const MesherOptions& options = {});

}  // namespace penumbra::sdf
