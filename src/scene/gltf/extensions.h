// Which glTF extensions are understood, and what is said about the others.
#pragma once

#include <string_view>

#include "scene/gltf/json_document.h"
#include "scene/gltf/warnings.h"

namespace penumbra::gltf {

bool is_implemented(std::string_view extension);

/// Throws InputError for the first of extensionsRequired that is not implemented; warns of those of
/// extensionsUsed that would change the picture.
void check_extensions(const JsonDocument& document, Warnings& warnings);

}  // namespace penumbra::gltf
