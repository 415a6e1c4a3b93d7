// Lights as glTF says them.
#pragma once

#include <json/value.h>

#include <set>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace penumbra::bake {

/// Appends a node for each light: points, spheres (with `extras.radius`) and suns by
/// KHR_lights_punctual, rectangles and disks by EXT_lights_area. Segments and meshes, which glTF
/// has no word for, are nodes with `extras` alone. Notes the extensions used.
///
/// `baked`: says `"baked": true` in the extras of nodes and lights, and in those of nodes also what
/// the light was: `light` with its type and numbers as in a scene file.
void add_lights(const std::vector<Light>& lights, bool baked, Json::Value& root,
                std::set<std::string>& extensions);

/// A node's matrix that stands at `origin`, looks along `direction` by its −Z and has +Y on the
/// side of `up`, as glTF's cameras and lights do.
Json::Value matrix_facing(const Vec3& origin, const Vec3& direction, const Vec3& up);

}  // namespace penumbra::bake
