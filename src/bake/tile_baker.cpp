#include "bake/tile_baker.h"

#include <algorithm>

#include "bake/awkward_shapes.h"
#include "bake/cost.h"
#include "bake/sample_weights.h"
#include "base/cancel.h"

namespace penumbra::bake {

const TexelSums& TileBaker::bake(const Occluders& occluders, const Tile& tile,
                                 const OwnTriangles& own, const SampledLight& light,
                                 BakeQuantity quantity) {
  lit_.resize(tile.width, tile.height);
  if (light.samples.empty()) return lit_;
  const bool needs_whole = bake::needs_whole(light, quantity);
  if (needs_whole) whole_.resize(tile.width, tile.height);
  TexelSums* whole = needs_whole ? &whole_ : nullptr;
  for_samples(occluders, tile, own, light, [&](std::size_t i, bool above, const BitRaster* hidden) {
    const TexelWeights weights = weights_of(tile, light, light.samples[i], quantity);
    if (above)
      accumulate(weights, hidden, lit_, whole);
    else if (whole)
      accumulate(weights, nullptr, *whole, nullptr);  // hidden, and counts as that
  });
  finish(tile, light, quantity, whole_, lit_);
  return lit_;
}

void TileBaker::for_samples(const Occluders& occluders, const Tile& tile, const OwnTriangles& own,
                            const SampledLight& light, const SampleVisitor& visit) {
  if (light.samples.empty()) return;
  raster_.resize(tile.width, tile.height);
  const std::size_t batch = raster_cost(occluders, tile, light).batch;
  for (std::size_t i = 0; i < light.samples.size(); i += batch) {
    throw_if_cancelled();
    visit_batch(occluders, tile, own, light, i, std::min(batch, light.samples.size() - i), visit);
  }
}

void TileBaker::visit_batch(const Occluders& occluders, const Tile& tile, const OwnTriangles& own,
                            const SampledLight& light, std::size_t first, std::size_t count,
                            const SampleVisitor& visit) {
  const std::span samples(&light.samples[first], count);
  const Shaft shaft(tile, light, samples, occluders);
  triangles_.clear(), masked_.clear(), spheres_.clear();
  if (!shaft.empty) {
    collect(occluders, shaft, own, light.own_instance, triangles_, masked_);
    for (const Sphere& s : occluders.spheres())
      if (shaft.meets(s.center, s.radius)) spheres_.push_back(s);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const bool above = is_above(tile, light, samples[i]);
    const bool any =
        above && draw_shadow(occluders, tile, light, samples[i], shaft.receiver_epsilon);
    visit(first + i, above, any ? &raster_ : nullptr);
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
