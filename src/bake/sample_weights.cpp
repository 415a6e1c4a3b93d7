#include "bake/sample_weights.h"

#include <numbers>

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

/// Of a sphere that nothing hides. Good until this thread's next call.
const TexelSums& whole_irradiance(const Tile& tile, const SampledLight& light) {
  thread_local TexelSums sums;
  sums.resize(tile.width, tile.height);
  const float up = tile.height_of(light.position);
  if (up >= light.radius) {
    // All of the sphere is above the horizon: π R² cos θ / r².
    TexelWeights w;
    w.falloff = Falloff::point;
    w.scale = pi * light.radius * light.radius * up;
    w.first = tile.origin - light.position;
    w.step_x = tile.step_x, w.step_y = tile.step_y;
    accumulate(w, nullptr, sums, nullptr);
    return sums;
  }
  for (int j = 0; j < tile.height; ++j)
    for (int i = 0; i < tile.width; ++i)
      sums.row(j)[i] = whole_irradiance_of(
          light,
          tile.origin + tile.step_x * static_cast<float>(i) + tile.step_y * static_cast<float>(j),
          tile.normal);
  return sums;
}

}  // namespace

TexelWeights weights_of(const Tile& tile, const SampledLight& light, const LightSample& sample,
                        BakeQuantity quantity) {
  TexelWeights w;
  w.falloff = falloff_of(light, quantity);
  w.step_x = tile.step_x, w.step_y = tile.step_y;
  w.normal = sample.normal;
  if (light.kind == EmitterKind::direction) {
    w.first = {1, 0, 0};
    if (quantity != BakeQuantity::visible_fraction)
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

std::optional<SampleView> view_of(const Occluders& occluders, const Tile& tile,
                                  const SampledLight& light, const LightSample& sample,
                                  float receiver_epsilon) {
  const bool far = light.kind == EmitterKind::direction;
  const Vec3d at(sample.position);
  const auto projection = far ? prism_to_box(at, tile.unit()) : pyramid_to_box(at, tile.unit());
  if (!projection) return std::nullopt;
  // What is computed to be higher than the sample by no more than the error of coordinates.
  const float least_w = far ? 0
                            : 2 * (occluders.epsilon_at(sample.position) + receiver_epsilon) /
                                  tile.height_of(sample.position);
  return SampleView{tile, *projection, least_w, far, at};
}

bool needs_whole(const SampledLight& light, BakeQuantity quantity) {
  return quantity != BakeQuantity::irradiance || light.is_ratio();
}

void finish(const Tile& tile, const SampledLight& light, BakeQuantity quantity,
            const TexelSums& whole, TexelSums& lit) {
  const bool is_fraction = quantity != BakeQuantity::irradiance;
  if (is_fraction) {
    normalise(lit, whole, nullptr);
  } else if (light.is_ratio()) {
    const TexelSums& by = whole_irradiance(tile, light);
    normalise(lit, whole, &by);
  }
  if (!is_fraction && light.is_spot)
    for (int j = 0; j < tile.height; ++j)
      for (int i = 0; i < tile.width; ++i)
        lit.row(j)[i] *= light.spot_part(tile.origin + tile.step_x * static_cast<float>(i) +
                                         tile.step_y * static_cast<float>(j));
}

}  // namespace penumbra::bake
