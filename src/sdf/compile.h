// A scene's field as a tape. Internal to the room.
#pragma once

#include "scene/scene.h"
#include "sdf/mesh_distance.h"
#include "sdf/tape.h"

namespace penumbra::sdf {

struct CompileOptions {
  bool only_distance_fields = false;  ///< leaves out spheres and meshes
  MeshDistances mesh_distance;        ///< for instances that are not exact; null = left out
};

/// Writes no recursion on the stack: any depth. InputError for a field too large for a tape.
Tape compile(const Scene& scene, const CompileOptions& options);

}  // namespace penumbra::sdf
