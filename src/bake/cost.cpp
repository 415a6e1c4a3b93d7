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
// Of a graphics processor of the middle class: estimated from its data sheet, with room to spare,
// so that it is asked only where it wins by far.
constexpr std::size_t gl_batch = 32, gl_pass = 256;  ///< samples that share a walk; a readback
constexpr float gl_starting = 300000 * nanosecond;   ///< a pass: draws, waiting, reading back
constexpr float gl_projecting = 2 * nanosecond;      ///< a triangle, on the graphics processor
constexpr float gl_filling = 0.02f * nanosecond;     ///< a texel and sample
constexpr float gl_reading = 4 * nanosecond;         ///< a texel and pass: 16 bytes

/// The triangles that samples meet which share a walk.
class Shafts {
 public:
  Shafts(const Occluders& occluders, const Tile& tile, const SampledLight& light)
      : all_(static_cast<float>(occluders.triangle_count())),
        count_(static_cast<float>(light.samples.size())),
        size_(length(tile.corner(1, 1) - tile.corner(0, 0))) {
    const Bounds& scene = occluders.bounds();
    Bounds samples;
    for (const LightSample& s : light.samples) samples.grow(s.position);
    apart_ = length(samples.size());
    if (light.kind == EmitterKind::direction) apart_ *= 0.5f * scene.diagonal();
    density_ = all_ / std::max(scene.half_area(), std::numeric_limits<float>::min());
  }
  float triangles(std::size_t batch) const {
    const auto n = static_cast<float>(batch);
    const float g = batch == 1 ? 0 : apart_ * std::min(1.0f, std::sqrt(n / count_));
    return std::min(density_ * (size_ * size_ + size_ * g + g * g) / 3, all_);
  }

 private:
  float all_, count_, size_, apart_ = 0, density_ = 0;
};

float texels_of(const Tile& tile) {
  return static_cast<float>(tile.width) * static_cast<float>(tile.height);
}

}  // namespace

RasterCost raster_cost(const Occluders& occluders, const Tile& tile, const SampledLight& light) {
  const Shafts shafts(occluders, tile, light);
  RasterCost best{most_in_batch, INFINITY};
  for (std::size_t b = most_in_batch; b > 0; b /= 2) {
    const auto n = static_cast<float>(b);
    const float seconds = shafts.triangles(b) * (projecting + looking / n) + walking / n;
    if (seconds < best.seconds) best = {b, seconds};
  }
  best.seconds = static_cast<float>(light.samples.size()) *
                 (best.seconds + sampling + summing * texels_of(tile));
  return best;
}

float ray_cost(const Tile& tile, const SampledLight& light) {
  return tracing * texels_of(tile) * static_cast<float>(light.samples.size());
}

float gl_cost(const Occluders& occluders, const Tile& tile, const SampledLight& light,
              std::size_t threads) {
  if (light.samples.empty()) return 0;
  const std::size_t count = light.samples.size();
  const std::size_t whole_walks = (count + gl_batch - 1) / gl_batch;
  const std::size_t whole_passes = (count + gl_pass - 1) / gl_pass;
  const auto walks = static_cast<float>(whole_walks), passes = static_cast<float>(whole_passes);
  const auto samples = static_cast<float>(count);
  const float triangles = Shafts(occluders, tile, light).triangles(gl_batch);
  const float texels = texels_of(tile);
  const float prepared = walks * (walking + looking * triangles) + sampling * samples;
  const float drawn = passes * (gl_starting + gl_reading * texels) +
                      samples * (gl_projecting * triangles + gl_filling * texels);
  return prepared + drawn * static_cast<float>(std::max<std::size_t>(threads, 1));
}

Way cheapest_way(const Occluders& occluders, const Tile& tile, std::span<const SampledLight> lights,
                 bool has_gl, std::size_t threads) {
  float raster = 0, rays = 0, gl = 0;
  for (const SampledLight& light : lights) {
    raster += raster_cost(occluders, tile, light).seconds;
    rays += ray_cost(tile, light);
    if (has_gl) gl += gl_cost(occluders, tile, light, threads);
  }
  if (has_gl && gl < raster && gl < rays) return Way::gl;
  return raster <= rays ? Way::raster : Way::rays;
}

}  // namespace penumbra::bake
