// The visibility stage of `area --error`: the first points everywhere, then more where a point or
// one next to it in the picture disagrees.
#pragma once

#include <span>
#include <vector>

#include "render/tile_visibility.h"

namespace penumbra {

/// As tile_visibility(), for shadows.adaptive() != null. `tile_width`: pixels a row of the tile.
/// A dark point at the tile's border is not taken at its first word, for its neighbours there are
/// not known; lit ones are proven, so tiles leave no trace beyond the allowed error.
void adaptive_visibility(const Shadows& shadows, std::size_t light,
                         std::span<const TilePoint> points, std::span<const std::uint8_t> asked,
                         int tile_width, std::span<LightArrival> arrivals,
                         std::vector<LightPoint>& scratch, ShadowCounts& counts);

}  // namespace penumbra
