// `penumbra info`: what was understood of a scene file.
#pragma once

#include <string>

#include "scene/scene.h"

namespace penumbra {

/// Several lines of text: format, counts, bounds, lights, cameras, conversions, warnings.
std::string describe(const Scene& scene);

}  // namespace penumbra
