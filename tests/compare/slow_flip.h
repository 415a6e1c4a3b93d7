// FLIP as its paper writes it down: in double precision, pixel by pixel, with two-dimensional
// kernels. Slow and obvious; shares nothing with src/compare.
#pragma once

#include "image/image.h"

namespace penumbra::test {

/// Of linear RGB pictures in [0, 1]; one channel.
Image slow_flip(const Image& reference, const Image& test, double pixels_per_degree);

/// Of two flat colours in [0, 1], by the colour term alone.
double slow_color_difference(const double (&a)[3], const double (&b)[3]);

}  // namespace penumbra::test
