// Where in a pixel its samples lie.
#pragma once

#include "base/vec.h"

namespace penumbra {

/// Sample `index` of `count` in [0, 1)²: the Hammersley set, in the middle of its strata. Each of
/// `count` columns holds one sample; if `count` is a power of two each row does too, and each cell
/// of every grid of `count` cells of power-of-two sides. One sample: the centre.
///
/// The same set in every pixel: an edge that is cut the same way everywhere shows as an even ramp,
/// where a set jittered by pixel would leave dots along it, and nothing crawls between the pictures
/// of a sequence.
Vec2 pixel_sample(int index, int count);

}  // namespace penumbra
