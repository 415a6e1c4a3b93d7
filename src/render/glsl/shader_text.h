// The GLSL files of this folder and shaders/soft_shadow.glsl, as parts of the program.
#pragma once

#include <string_view>

namespace penumbra {

/// The text of a file, by its name without folder; empty if there is none.
std::string_view shader_text(std::string_view name);

}  // namespace penumbra
