// Counts as colours.
#pragma once

#include "image/image.h"

namespace penumbra {

/// Colours, linear, for an image of one channel of counts: black up to 1, indigo at 4, teal at 16,
/// yellow at 64, white from 256, and between them by the logarithm, ever lighter. The scale does
/// not depend on the image, so that pictures compare. NaN is black.
Image heat_map(const Image& counts);

}  // namespace penumbra
