// Which conversions between triangles and distance fields a scene needs, and with what options.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "sdf/mesh_distance.h"

namespace penumbra::sdf {

struct ConversionOptions {
  std::optional<double> voxel_size{};  ///< --voxel-size, metres; unset = 1/128 of the longest side
  std::optional<Bounds> bounds{};      ///< --bounds: what of distance fields becomes triangles
  bool keep_files = true;              ///< grids beside the files of the meshes, mesh_grid.h
};

/// For FieldOptions::mesh_distance. Instances whose transform keeps angles share the grid of their
/// mesh; the others have one of their own, in the world's frame and without a file. Thread-safe.
MeshDistances mesh_distances(const ConversionOptions& options);

/// A line for each mesh that has distances by a grid, then for the fields, for people.
std::vector<std::string> describe_conversions(const Scene& scene, const ConversionOptions& options);

}  // namespace penumbra::sdf
