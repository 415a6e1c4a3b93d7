// glTF mesh primitives as triangle meshes.
#pragma once

#include <optional>

#include "scene/gltf/document.h"
#include "scene/scene.h"

namespace penumbra::gltf {

/// The triangles of model().meshes[mesh].primitives[primitive]; no value (and a warning) for
/// points, lines and primitives without positions. Holds only the vertices that the indices use, in
/// their order.
/// Throws InputError with the path of an attribute that is of no allowed type, too short or too
/// long, and of an index out of range.
std::optional<Mesh> read_primitive(Document& document, std::size_t mesh, std::size_t primitive);

}  // namespace penumbra::gltf
