// Materials as GLSL.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace penumbra {

/// struct pnb_Material.
std::string material_type();

/// pnb_material_of(int), by index into Scene::materials, and pnb_mix_materials(a, b, share of b).
/// Textures are left out, with a warning.
std::string material_functions(const Scene& scene, std::vector<std::string>& warnings);

}  // namespace penumbra
