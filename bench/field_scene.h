// Scenes of many distance-field shapes.
#pragma once

#include "scene/scene.h"

namespace penumbra::bench {

/// A floor and count − 1 boxes, balls and tori spread over it in no order, as large as makes them
/// cover the same part of the picture whatever the count, under a sphere light. smooth: one smooth
/// union of them all, k = 0.05; else a union.
Scene field_scene(int count, bool smooth);

}  // namespace penumbra::bench
