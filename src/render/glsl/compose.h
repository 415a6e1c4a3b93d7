// Whole fragment shaders.
#pragma once

#include <string>

#include "render/glsl/field_text.h"
#include "render/glsl/light_text.h"
#include "shadow/shadows.h"

namespace penumbra {

enum class ShaderTask { picture, picture_with_layers, probe, own_picture };

/// The number that compile messages give to lines of the person's file; ours is 0.
inline constexpr int user_source = 1;

/// A whole GLSL ES 3.00 fragment shader.
std::string compose_shader(const FieldText& field, const std::vector<ShaderLight>& lights,
                           const ShadowOptions& shadows, ShaderTask task);

}  // namespace penumbra
