#include "bake/tile_baker.h"

#include <algorithm>
#include <numbers>

#include "bake/awkward_shapes.h"
#include "bake/cost.h"

namespace penumbra::bake {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
Falloff falloff_of(const SampledLight& light, BakeQuantity quantity) {
  if (quantity == BakeQuantity::visible_fraction) {
    if (light.measure == FractionMeasure::count) return Falloff::constant;
    if (light.measure == FractionMeasure::turned && !light.two_sided) return Falloff::turned;
    return light.measure == FractionMeasure::solid_angle ? Falloff::solid_angle : Falloff::constant;
  }
  switch (light.kind) {
    case EmitterKind::point:
      return Falloff::point;
    case EmitterKind::direction:
      return Falloff::constant;
    case EmitterKind::strip:
      return Falloff::strip;
    default:
      return light.two_sided ? Falloff::two_sided : Falloff::surface;
  }
}

/// irradiance_of() and share_of() as functions of the texel.
TexelWeights weights_of(const Tile& tile, const SampledLight& light, const LightSample& sample,
                        BakeQuantity quantity) {
  TexelWeights w;
  w.falloff = falloff_of(light, quantity);
  w.step_x = tile.step_x, w.step_y = tile.step_y;
  w.normal = sample.normal;
  if (light.kind == EmitterKind::direction) {
    w.first = {1, 0, 0};
    if (quantity == BakeQuantity::irradiance)
      w.scale = sample.weight * std::max(0.0f, dot(sample.position, tile.normal));
    return w;
  }
  w.first = tile.origin - sample.position;
  if (quantity == BakeQuantity::visible_fraction) {
    if (light.measure == FractionMeasure::solid_angle) w.scale = sample.weight;
    return w;
  }
  const float up = std::max(0.0f, -dot(w.first, tile.normal));
  w.scale = light.kind == EmitterKind::point ? up : up * sample.weight;
  w.k = sample.weight / pi;
  return w;
}

bool is_above(const Tile& tile, const SampledLight& light, const LightSample& sample) {
  if (light.kind == EmitterKind::direction) return dot(sample.position, tile.normal) > 0;
  return tile.height_of(sample.position) > 0;
}

}  // namespace

const TexelSums& TileBaker::bake(const Occluders& occluders, const Tile& tile,
                                 const OwnTriangles& own, const SampledLight& light,
                                 BakeQuantity quantity) {
  lit_.resize(tile.width, tile.height);
  if (light.samples.empty()) return lit_;
  raster_.resize(tile.width, tile.height);
  const bool is_fraction = quantity == BakeQuantity::visible_fraction;
  const bool needs_whole = is_fraction || light.is_ratio();
  if (needs_whole) whole_.resize(tile.width, tile.height);
  const std::span<const LightSample> samples(light.samples);
  const std::size_t batch = raster_cost(occluders, tile, light).batch;
  for (std::size_t i = 0; i < samples.size(); i += batch)
    add_samples(occluders, tile, own, light,
                samples.subspan(i, std::min(batch, samples.size() - i)), quantity,
                needs_whole ? &whole_ : nullptr);
  if (is_fraction) {
    normalise(lit_, whole_, nullptr);
  } else if (light.is_ratio()) {
    set_whole_irradiance(tile, light);
    normalise(lit_, whole_, &closed_form_);
  }
  if (!is_fraction && light.is_spot)
    for (int j = 0; j < tile.height; ++j)
      for (int i = 0; i < tile.width; ++i)
        lit_.row(j)[i] *= light.spot_part(tile.origin + tile.step_x * static_cast<float>(i) +
                                          tile.step_y * static_cast<float>(j));
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
  const bool far = light.kind == EmitterKind::direction;
  const Vec3d at(sample.position);
  const auto projection = far ? prism_to_box(at, tile.unit()) : pyramid_to_box(at, tile.unit());
  if (!projection) return false;
  // What is computed to be higher than the sample by no more than the error of coordinates.
  const float least_w = far ? 0
                            : 2 * (occluders.epsilon_at(sample.position) + receiver_epsilon) /
                                  tile.height_of(sample.position);
  raster_.clear();
  awkward_.clear();
  bool any = draw(triangles_, Projection(*projection, least_w), raster_, awkward_);
  const SampleView view{tile, *projection, least_w, far, at};
  for (const std::uint32_t t : awkward_) {
    const Vec3 corners[] = {triangles_.at(t, 0), triangles_.at(t, 1), triangles_.at(t, 2)};
    draw_triangle(view, corners, raster_);
  }
  for (const MaskedTriangle& t : masked_)
    draw_masked(view, t, *occluders.mask(t.instance), receiver_epsilon, raster_);
  for (const Sphere& s : spheres_) draw_sphere(view, s.center, s.radius, raster_);
  return any || !awkward_.empty() || !masked_.empty() || !spheres_.empty();
}

void TileBaker::set_whole_irradiance(const Tile& tile, const SampledLight& light) {
  closed_form_.resize(tile.width, tile.height);
  const float up = tile.height_of(light.position);
  if (up >= light.radius) {
    // All of the sphere is above the horizon: π R² cos θ / r².
    TexelWeights w;
    w.falloff = Falloff::point;
    w.scale = pi * light.radius * light.radius * up;
    w.first = tile.origin - light.position;
    w.step_x = tile.step_x, w.step_y = tile.step_y;
    return accumulate(w, nullptr, closed_form_, nullptr);
  }
  for (int j = 0; j < tile.height; ++j)
    for (int i = 0; i < tile.width; ++i)
      closed_form_.row(j)[i] = whole_irradiance_of(
          light,
          tile.origin + tile.step_x * static_cast<float>(i) + tile.step_y * static_cast<float>(j),
          tile.normal);
}

}  // namespace penumbra::bake
