// The faces of a mesh light whose emission has a texture.
#pragma once

#include <vector>

#include "shadow/mesh_light.h"

namespace penumbra {

/// The light's triangles, cut into parts of which the texture makes about equally bright ones: four
/// by four until a part is a texel or smaller, or there are 32,768, and put together again where
/// four differ by less than a 256th of full brightness. Dark parts are left out.
///
/// The light is one colour channel of the texture (Light::emission says which): a part's brightness
/// is that channel's mean over it, in [0, 1], and its area is multiplied by it. What chooses points
/// evenly by such areas chooses them by the light that they stand for.
std::vector<LightFace> textured_faces(const Scene& scene, const Light& light);

}  // namespace penumbra
