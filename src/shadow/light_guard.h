// "Is the whole light seen?", by one cone and no ray.
#pragma once

#include "shadow/shadows.h"

namespace penumbra {

/// True if nothing at all is in the cone from the receiver round the whole light, and the whole
/// light is above the horizon: then every ray to it is free, and none need be traced. False says
/// nothing. Counts a cone.
bool whole_light_is_seen(const World& world, const LightViews& lights, const Receiver& receiver,
                         std::size_t light, ShadowCounts& counts);

}  // namespace penumbra
