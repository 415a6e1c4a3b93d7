// Cut-out textures as GLSL.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace penumbra {

inline constexpr int mask_texel_row = 4096;

/// pnb_is_cut_out(pnb_Facet) and PNB_MASKS, if a mesh of the scene has holes by its texture; else
/// empty. `texels` gets the masks (AlphaMask), four distances a texel.
std::string mask_functions(const Scene& scene, std::vector<float>& texels);

}  // namespace penumbra
