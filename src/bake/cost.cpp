#include "bake/cost.h"

#include <cmath>
#include <limits>

namespace penumbra::bake {
namespace {

// Measured with bench/bench_bake on an EPYC of 2021, rounded; only their ratios matter.
constexpr float nanosecond = 1e-9f;
constexpr float projecting = 2 * nanosecond;  ///< a triangle, few of which reach the tile
constexpr float looking = 5 * nanosecond;     ///< at a triangle that may be in a shaft
constexpr float walking = 2400 * nanosecond;  ///< through the tree, to begin with
constexpr float sampling = 500 * nanosecond;  ///< the matrix and all else that a sample needs
constexpr float summing = 0.6f * nanosecond;  ///< a texel
constexpr float tracing = 80 * nanosecond;    ///< a shadow ray
constexpr std::size_t most_in_batch = 16;

}  // namespace

RasterCost raster_cost(const Occluders& occluders, const Tile& tile, const SampledLight& light) {
  const Bounds& scene = occluders.bounds();
  Bounds samples;
  for (const LightSample& s : light.samples) samples.grow(s.position);
  float apart = length(samples.size());
  if (light.kind == EmitterKind::direction) apart *= 0.5f * scene.diagonal();
  const float size = length(tile.corner(1, 1) - tile.corner(0, 0));
  const float density = static_cast<float>(occluders.triangle_count()) /
                        std::max(scene.half_area(), std::numeric_limits<float>::min());
  const auto count = static_cast<float>(light.samples.size());
  RasterCost best{most_in_batch, INFINITY};
  for (std::size_t b = most_in_batch; b > 0; b /= 2) {
    const auto n = static_cast<float>(b);
    const float g = b == 1 ? 0 : apart * std::min(1.0f, std::sqrt(n / count));
    const float triangles = std::min(density * (size * size + size * g + g * g) / 3,
                                     static_cast<float>(occluders.triangle_count()));
    const float seconds = triangles * (projecting + looking / n) + walking / n;
    if (seconds < best.seconds) best = {b, seconds};
  }
  const float texels = static_cast<float>(tile.width) * static_cast<float>(tile.height);
  best.seconds = count * (best.seconds + sampling + summing * texels);
  return best;
}

float ray_cost(const Tile& tile, const SampledLight& light) {
  return tracing * static_cast<float>(tile.width) * static_cast<float>(tile.height) *
         static_cast<float>(light.samples.size());
}

}  // namespace penumbra::bake
