// Materials as GLSL.
#pragma once

#include <string>
#include <vector>

#include "render/glsl/image_bytes.h"
#include "scene/scene.h"

namespace penumbra {

/// struct pnb_Material.
std::string material_type();

/// pnb_material_of(int), by index into Scene::materials, and pnb_mix_materials(a, b, share of b).
/// Of textures, what shapes without texture coordinates show.
std::string material_functions(const Scene& scene);

/// pnb_facet_material(pnb_Facet, …): with textures, and without the emission of backs that have
/// none. Gives `images` what it looks up.
std::string facet_materials(const Scene& scene, ImageBytes& images);

}  // namespace penumbra
