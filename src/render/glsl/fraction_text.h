// The visible fraction of a light in GLSL.
#pragma once

#include <string>

#include "shadow/shadows.h"

namespace penumbra {

/// pnb_fraction(light, p, n) for a method that looks at the light's centre, and for none.
std::string fraction_function(const ShadowOptions& shadows);

}  // namespace penumbra
