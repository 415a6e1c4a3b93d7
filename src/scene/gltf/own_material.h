// Materials of scene files in glTF: what its own model has no word for.
#pragma once

#include <json/value.h>

#include "scene/scene.h"

namespace penumbra::gltf {

/// Reads `extras.penumbra` of a material as penumbra bake writes it: `diffuse`, `specular`,
/// `mirror` ([r, g, b], 0 to 1) and `roughness` instead of the metallic-roughness model. Leaves
/// `out` as it is where one of them is missing or no such thing.
void read_own_material(const Json::Value& material, Material& out);

}  // namespace penumbra::gltf
