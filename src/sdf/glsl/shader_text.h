// The GLSL files of this folder, as parts of the program.
#pragma once

#include <string_view>

namespace penumbra {

/// The text of a file, by its name without folder; empty if there is none.
std::string_view sdf_shader_text(std::string_view name);

}  // namespace penumbra
