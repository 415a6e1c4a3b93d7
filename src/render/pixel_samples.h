// Where in a pixel its samples lie.
#pragma once

#include <cstdint>

#include "base/vec.h"

namespace penumbra {

/// Sample `index` of `count` in [0, 1)². One sample: the centre. A square number: one sample
/// jittered in each cell of a grid. Else a Hammersley set shifted round the torus by the hash
/// (Cranley and Patterson 1976), so that each of `count` columns holds one sample.
/// `pixel_hash` decorrelates pixels; the same arguments give the same point.
Vec2 pixel_sample(int index, int count, std::uint64_t pixel_hash);

}  // namespace penumbra
