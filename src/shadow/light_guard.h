// "Does anything block a part of the light?", by one cone and no ray.
#pragma once

#include "shadow/shadows.h"

namespace penumbra {

enum class LightGuard : std::uint8_t {
  unknown,     ///< says nothing
  unoccluded,  ///< nothing above the horizon blocks any part of the light; some of it is below
  seen,        ///< the same, and all of the light is above the horizon
};

/// Asks one cone round the whole light; counts it.
LightGuard guard_light(const World& world, const LightViews& lights, const Receiver& receiver,
                       std::size_t light, ShadowCounts& counts);

/// True if nothing at all is in the cone from the receiver round the whole light, and the whole
/// light is above the horizon: then every ray to it is free, and none need be traced. False says
/// nothing. Counts a cone.
bool whole_light_is_seen(const World& world, const LightViews& lights, const Receiver& receiver,
                         std::size_t light, ShadowCounts& counts);

}  // namespace penumbra
