// glTF's metallic-roughness materials.
#pragma once

#include <vector>

#include "scene/gltf/document.h"
#include "scene/gltf/textures.h"
#include "scene/scene.h"

namespace penumbra::gltf {

/// How much of the light a metal reflects as a mirror does: a renderer without an environment shows
/// smooth metals black otherwise. For metallic ≥ 0.5 it falls linearly from the base colour ·
/// metallic at roughness 0 to nothing at roughness 0.15; for less metallic surfaces it is nothing.
Vec3 mirror_of_metal(const Vec3& base_color, float metallic, float roughness);

/// One material for each of the file, in its order; see scene.h for the fields. Factors are clamped
/// to [0, 1]. A mirror comes from the factors alone, and from none where a texture varies them.
/// alphaMode BLEND is opaque, with a warning.
std::vector<Material> read_materials(Document& document, Textures& textures);

/// What a primitive without a material is shown as: matte light grey. (glTF 2.0 asks for a rough
/// white metal, which is black without an environment.)
Material default_material();

}  // namespace penumbra::gltf
