// Points of the unit square, one in each of n cells of equal area.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/bake_options.h"
#include "base/vec.h"

namespace penumbra::bake {

/// `count` points for a domain `aspect` times as wide as it is high. The cells lie in rows that are
/// as high as they have cells, about square in the domain. The points are in the order of the
/// Morton curve, so that neighbours in the list are neighbours on the light; the same arguments
/// give the same points. `seed` is for the jitter.
std::vector<Vec2> sample_grid(int count, float aspect, SamplePlacement placement,
                              std::uint64_t seed);

}  // namespace penumbra::bake
