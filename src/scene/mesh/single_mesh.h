// Scenes of what one mesh file holds.
#pragma once

#include <string>

#include "scene/scene.h"

namespace penumbra {

/// The file's name without folder and extensions: "bunny" of "models/bunny.ply.gz".
std::string stem_of(const std::string& path);

/// Adds an object with one mesh of material `material` in place.
void add_object(Scene& scene, const std::string& name, Mesh mesh, std::uint32_t material);

}  // namespace penumbra
