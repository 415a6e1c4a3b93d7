// Distance fields as shaders.
#pragma once

#include <string>

#include "scene/scene.h"

namespace penumbra {

/// Reads a shader file. InputError if it cannot be read or if neither `map` nor `mainImage` is
/// called or defined anywhere in it, comments apart.
GlslSource read_glsl_source(const std::string& path);

/// A shader on its own: seen from (3.2, 2.6, 4.4) towards (0, 0.4, 0), 40° high, under a sun of 6°
/// along (−0.5, −0.8, −0.3) that gives what faces it an irradiance of π.
Scene read_glsl_scene(const std::string& path);

}  // namespace penumbra
