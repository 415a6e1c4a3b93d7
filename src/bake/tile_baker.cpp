#include "bake/tile_baker.h"

#include <algorithm>
#include <limits>

#include "bake/awkward_shapes.h"
#include "bake/sample_weights.h"

namespace penumbra::bake {
namespace {

/// Samples that share a walk through the occluders, neighbours on the light: at most this many.
constexpr std::size_t most_in_batch = 16;
/// What it costs to look at a triangle that may be in a shaft, and to walk there, in triangles
/// projected in vain (measured, and rounded).
constexpr float cost_of_look = 4, cost_of_walk = 2000;

/// The number of samples a batch with the least cost. A shaft from a tile of size d to samples g
/// apart is (d² + d g + g²) / 3 in mean section, and holds as large a share of the triangles as it
/// takes of the section of the scene: many samples share a walk, but draw what is in the way of any
/// of them.
std::size_t batch_size(const Occluders& occluders, const Tile& tile, const SampledLight& light) {
  const Bounds& scene = occluders.bounds();
  Bounds samples;
  for (const LightSample& s : light.samples) samples.grow(s.position);
  float apart = samples.diagonal();
  if (light.kind == EmitterKind::direction) apart *= 0.5f * scene.diagonal();
  const float size = length(tile.corner(1, 1) - tile.corner(0, 0));
  const float density = static_cast<float>(occluders.triangle_count()) /
                        std::max(scene.half_area(), std::numeric_limits<float>::min());
  const auto count = static_cast<float>(light.samples.size());
  std::size_t best = most_in_batch;
  float least = INFINITY;
  for (std::size_t b = most_in_batch; b > 0; b /= 2) {
    const auto n = static_cast<float>(b);
    const float g = b == 1 ? 0 : apart * std::min(1.0f, std::sqrt(n / count));
    const float triangles = density * (size * size + size * g + g * g) / 3;
    const float cost = triangles * (1 + cost_of_look / n) + cost_of_walk / n;
    if (cost < least) least = cost, best = b;
  }
  return best;
}

}  // namespace

const TexelSums& TileBaker::bake(const Occluders& occluders, const Tile& tile,
                                 const OwnTriangles& own, const SampledLight& light,
                                 BakeQuantity quantity) {
  lit_.resize(tile.width, tile.height);
  if (light.samples.empty()) return lit_;
  raster_.resize(tile.width, tile.height);
  const bool needs_whole = bake::needs_whole(light, quantity);
  if (needs_whole) whole_.resize(tile.width, tile.height);
  const std::span<const LightSample> samples(light.samples);
  const std::size_t batch = batch_size(occluders, tile, light);
  for (std::size_t i = 0; i < samples.size(); i += batch)
    add_samples(occluders, tile, own, light,
                samples.subspan(i, std::min(batch, samples.size() - i)), quantity,
                needs_whole ? &whole_ : nullptr);
  finish(tile, light, quantity, whole_, lit_);
  return lit_;
}

void TileBaker::add_samples(const Occluders& occluders, const Tile& tile, const OwnTriangles& own,
                            const SampledLight& light, std::span<const LightSample> samples,
                            BakeQuantity quantity, TexelSums* whole) {
  const Shaft shaft(tile, light, samples, occluders);
  triangles_.clear(), masked_.clear(), spheres_.clear();
  if (!shaft.empty) {
    collect(occluders, shaft, own, light.own_instance, triangles_, masked_);
    for (const Sphere& s : occluders.spheres())
      if (shaft.meets(s.center, s.radius)) spheres_.push_back(s);
  }
  for (const LightSample& sample : samples) {
    const TexelWeights weights = weights_of(tile, light, sample, quantity);
    if (!is_above(tile, light, sample)) {
      // Below the horizon it is hidden, and counts as that.
      if (whole) accumulate(weights, nullptr, *whole, nullptr);
      continue;
    }
    const bool any = draw_shadow(occluders, tile, light, sample, shaft.receiver_epsilon);
    accumulate(weights, any ? &raster_ : nullptr, lit_, whole);
  }
}

bool TileBaker::draw_shadow(const Occluders& occluders, const Tile& tile, const SampledLight& light,
                            const LightSample& sample, float receiver_epsilon) {
  if (triangles_.count == 0 && masked_.empty() && spheres_.empty()) return false;
  const auto view = view_of(occluders, tile, light, sample, receiver_epsilon);
  if (!view) return false;
  raster_.clear();
  awkward_.clear();
  bool any = draw(triangles_, Projection(view->projection, static_cast<float>(view->least_w)),
                  raster_, awkward_);
  for (const std::uint32_t t : awkward_) {
    const Vec3 corners[] = {triangles_.at(t, 0), triangles_.at(t, 1), triangles_.at(t, 2)};
    draw_triangle(*view, corners, raster_);
  }
  for (const MaskedTriangle& t : masked_)
    draw_masked(*view, t, *occluders.mask(t.instance), receiver_epsilon, raster_);
  for (const Sphere& s : spheres_) draw_sphere(*view, s.center, s.radius, raster_);
  return any || !awkward_.empty() || !masked_.empty() || !spheres_.empty();
}

}  // namespace penumbra::bake
