// Mesh lights as texels for mesh_light.glsl. Internal to the room.
#pragma once

#include <vector>

#include "shadow/mesh_light.h"

namespace penumbra {

/// Appends the light's texels, four floats each; returns the number of the first.
int add_mesh_light(const MeshLight& mesh, bool double_sided, std::vector<float>& texels);

}  // namespace penumbra
