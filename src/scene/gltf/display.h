// How a baked file asks to be shown: `asset.extras.penumbra`, which `penumbra bake` writes.
#pragma once

#include <optional>

#include "scene/gltf/json_document.h"
#include "scene/scene.h"

namespace penumbra::gltf {

/// `exposure_ev` in [−100, 100]: base colours of unlit materials are radiance · 2^EV. No value if
/// the file does not say so.
std::optional<double> exposure_of(const JsonDocument& document);

/// Sets the scene's exposure and, from `background` (radiance), its background.
void read_display(const JsonDocument& document, Scene& scene);

}  // namespace penumbra::gltf
