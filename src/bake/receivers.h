// Which surfaces are baked, and which of their sides.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake/adjacency.h"

namespace penumbra::bake {

/// By instance: Object::samples_scale.
std::vector<float> samples_scales(const Scene& scene);

/// By instance: true if its object receives light in textures. `names`: objects' names; empty: all
/// but those whose file says "receives": false. Throws InputError for a name that no object has and
/// where nothing is left.
std::vector<bool> receivers_of(const Scene& scene, const std::vector<std::string>& names);

/// Whether the back of an instance's triangles may be seen: its material is double-sided, and it is
/// no closed body that faces outwards with nothing (no camera, light or other object) within its
/// bounds.
bool has_back(const Scene& scene, const WorldMesh& mesh, const Adjacency& adjacency);

}  // namespace penumbra::bake
