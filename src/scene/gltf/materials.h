// glTF's metallic-roughness materials.
#pragma once

#include <vector>

#include "scene/gltf/document.h"
#include "scene/gltf/textures.h"
#include "scene/scene.h"

namespace penumbra::gltf {

/// One material for each of the file, in its order; see scene.h for the fields. Factors are clamped
/// to [0, 1]. A mirror comes from the factors alone, and from none where a texture varies them.
/// alphaMode BLEND is opaque, with a warning.
std::vector<Material> read_materials(Document& document, Textures& textures);

/// What a primitive without a material is shown as: matte light grey. (glTF 2.0 asks for a rough
/// white metal, which is black without an environment.)
Material default_material();

}  // namespace penumbra::gltf
