// One step down a mip pyramid.
#pragma once

#include "image/texture.h"

namespace penumbra {

/// Half the size (rounded down, at least one texel), each new texel the mean of the area it covers,
/// exactly also for odd sizes. Colour is averaged in linear light if `srgb`.
TextureImage halved(const TextureImage& image, bool srgb);

}  // namespace penumbra
