// --light-factor: lights of other brightness and colour.
#pragma once

#include <string>

#include "scene/scene.h"

namespace penumbra::app {

struct LightFactor {
  std::string light;  ///< name or index
  Vec3 factor;        ///< of its emission, 0 or more
};

/// From LIGHT=F or LIGHT=R,G,B; throws InputError.
LightFactor parse_light_factor(const std::string& text);

/// A mesh light's surface is seen to emit as much. Throws InputError where no light has the name.
void apply(const LightFactor& factor, Scene& scene);

}  // namespace penumbra::app
