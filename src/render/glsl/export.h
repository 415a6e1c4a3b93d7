// Scenes as shaders that stand alone.
#pragma once

#include <string>

#include "render/glsl/field_text.h"
#include "render/render.h"

namespace penumbra {

/// A complete shader for Shadertoy (GLSL ES 3.00 with mainImage): the scene's field, camera and
/// lights, the chosen shadow function, `spp` samples a pixel. It shows what render_gl shows,
/// encoded as sRGB. `exposure_ev` and `ambient` are those of a render; `source` names the scene in
/// a comment. Throws InputError for `area` and for methods without a shader.
std::string shadertoy_text(const Scene& scene, const FieldText& field, const RenderOptions& options,
                           float exposure_ev, const Vec3& ambient, const std::string& source);

}  // namespace penumbra
