#include "bake/tile_baker.h"

#include <algorithm>

#include "bake/awkward_shapes.h"
#include "bake/cost.h"
#include "bake/sample_weights.h"

namespace penumbra::bake {

const TexelSums& TileBaker::bake(const Occluders& occluders, const Tile& tile,
                                 const OwnTriangles& own, const SampledLight& light,
                                 BakeQuantity quantity) {
  lit_.resize(tile.width, tile.height);
  if (light.samples.empty()) return lit_;
  raster_.resize(tile.width, tile.height);
  const bool needs_whole = bake::needs_whole(light, quantity);
  if (needs_whole) whole_.resize(tile.width, tile.height);
  const std::span<const LightSample> samples(light.samples);
  const std::size_t batch = raster_cost(occluders, tile, light).batch;
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
