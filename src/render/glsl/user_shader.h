// A person's own shader, read far enough to put it among ours.
#pragma once

#include <string>
#include <vector>

namespace penumbra {

/// What a shader file has, comments apart.
struct UserShader {
  std::string file;  ///< for messages
  std::string code;  ///< ready to stand after our declarations, line by line as in the file
  std::vector<std::string> macros;    ///< names that it defines
  std::vector<std::string> channels;  ///< iChannel0 … 3 where they are used
  bool has_map = false;               ///< float map(…)
  bool has_albedo = false;            ///< vec3 albedo(…)
  bool has_main_image = false;        ///< void mainImage(…)
};

/// Reads a text. Left out of the code: comments, #version, and declarations of Shadertoy's
/// uniforms, since ours stand before it. Renamed: main, names that begin with pnb_ or penumbra_ as
/// ours do, and gl_FragCoord to pnb_FragCoord, which counts over the whole picture. Throws
/// InputError if there is neither map nor mainImage, or if map does not return float.
UserShader read_user_shader(const std::string& file, const std::string& text);

/// #undef of its macros, to stand between its code and ours. map, albedo and mainImage may be
/// macros.
std::string without_macros(const UserShader& shader);

}  // namespace penumbra
