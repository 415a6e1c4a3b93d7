// The visibility stage: how much of one light's unshadowed reflection reaches each point of a tile.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/tile_point.h"

namespace penumbra {

/// Of one light, at one point.
struct LightArrival {
  float diffuse = 1;  ///< part of the unshadowed diffuse reflection that arrives, in [0, 1]
  float glossy = 1;   ///< of the glossy one
  Visibility visibility;
};

/// Fills arrivals[i] for every points[i] with asked[i] != 0; the others keep what they have.
/// The three spans are of one size; `tile_width`: pixels a row of the tile that points[i].pixel
/// counts in. `scratch` is reused memory.
///
/// Methods with a visible fraction: both parts are that fraction. `area`: the ratio of the light
/// points' sum with to that without visibility, cosines and lobe inside, so that analytic light ·
/// ratio converges to Heckbert and Herf's equation (1) and is free of noise where nothing blocks
/// (Heitz, Hill, McGuire 2018, Combining Analytic Direct Illumination and Stochastic Shadows).
void tile_visibility(const Shadows& shadows, std::size_t light, std::span<const TilePoint> points,
                     std::span<const std::uint8_t> asked, int tile_width,
                     std::span<LightArrival> arrivals, std::vector<LightPoint>& scratch,
                     ShadowCounts& counts);

/// The two ratios over a set of light points; 0 where no point of the light is above the horizon.
LightArrival arrival_from(std::span<const LightPoint> light_points, const ShadingPoint& point);

/// The same with the part of each point that is seen, in [0, 1], instead of LightPoint::visible.
LightArrival arrival_from(std::span<const LightPoint> light_points, std::span<const float> seen,
                          const ShadingPoint& point);

/// The same for what Shadows::light_points() answered: without points all or nothing arrives.
LightArrival arrival_of(const Visibility& seen, std::span<const LightPoint> light_points,
                        const ShadingPoint& point);

}  // namespace penumbra
