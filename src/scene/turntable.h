// A camera that goes round the scene.
#pragma once

#include "scene/scene.h"

namespace penumbra {

/// The camera turned by `angle` radians, counterclockwise seen from above, about the upright axis
/// through the point of its view line nearest to the centre of the scene's extent.
Camera turned_about_scene(const Camera& camera, const Bounds& extent, double angle);

}  // namespace penumbra
