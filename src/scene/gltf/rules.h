// What a glTF document must look like before anything in it is believed.
#pragma once

#include "scene/gltf/json_document.h"

namespace penumbra::gltf {

/// Checks what says how to read the rest: asset, extensionsUsed, extensionsRequired. To come first,
/// so that a file of another version or with a strange extension is refused for that.
void check_declarations(JsonDocument& document);

/// Checks type and range of every property that is read from here on: every index points to an
/// element that exists, every count is a whole number below 2^53, every enumerated value is one of
/// glTF 2.0's. Whole numbers written as 3.0 become 3. Throws InputError with place and path.
void check_document(JsonDocument& document);

}  // namespace penumbra::gltf
