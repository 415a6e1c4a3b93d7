// Whole fragment shaders.
#pragma once

#include <string>

#include "render/glsl/field_text.h"
#include "render/glsl/light_text.h"
#include "shadow/shadows.h"

namespace penumbra {

enum class ShaderTask { picture, picture_with_layers, probe, own_picture };

/// Compile messages give smaller numbers to lines of the person's file. (Some drivers forget the
/// number of the source, so it does not tell.)
inline constexpr int first_line_of_ours = 1'000'000;

/// A whole GLSL ES 3.00 fragment shader.
std::string compose_shader(const FieldText& field, const ShaderLights& lights,
                           const ShadowOptions& shadows, ShaderTask task);

}  // namespace penumbra
