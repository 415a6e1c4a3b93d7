// Lights that nodes of a glTF file carry.
#pragma once

#include <vector>

#include "scene/gltf/document.h"
#include "scene/gltf/node_tree.h"
#include "scene/scene.h"

namespace penumbra::gltf {

/// One light for each use by a node of the scene, in the nodes' order, named after the light or
/// else the node. Lights stand at the node's origin and shine along its −Z.
///
/// KHR_lights_punctual: point and spot lights (candela) become point lights, or, with
/// `extras.radius` > 0 on the light or the node (which takes precedence), sphere lights of that
/// radius whose radiance gives the same intensity, I / (π r²); a spot keeps its cone. Directional
/// lights (lux) become suns of `extras.angular_diameter_deg` (0, the default, is a sun without
/// size). `range` is not read.
///
/// EXT_lights_area (draft of 2025): `rect` of height `size` along the node's y and width
/// size · aspect along x, `disk` of diameter `size`, `intensity` in nits (1000), one-sided. Read
/// leniently: `aspect` may stand in `rect` or in the light, the type may be called `shape`.
///
/// Sizes are multiplied by the node's largest world scale, as that draft has it.
std::vector<Light> read_lights(Document& document, const NodeTree& tree);

}  // namespace penumbra::gltf
