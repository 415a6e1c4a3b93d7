#include "render/tile_visibility.h"

#include "render/ggx.h"
#include "render/tile_adaptive.h"

namespace penumbra {
namespace {

/// Σ visible · x / Σ x.
struct Ratio {
  float seen = 0, all = 0;

  void add(float x, bool visible) {
    all += x;
    if (visible) seen += x;
  }
  float value() const { return all > 0 ? seen / all : 0; }
};

LightArrival arrival_at(const Shadows& shadows, std::size_t light, const TilePoint& point,
                        std::vector<LightPoint>& scratch, ShadowCounts& counts) {
  LightArrival arrival;
  if (shadows.sums_light_points()) {
    const Visibility seen =
        shadows.light_points(point.receiver, light, point.stream, scratch, counts);
    return arrival_of(seen, scratch, point.shading);
  }
  arrival.visibility = shadows.visibility(point.receiver, light, point.stream, counts);
  arrival.diffuse = arrival.glossy = arrival.visibility.fraction;
  return arrival;
}

}  // namespace

LightArrival arrival_of(const Visibility& seen, std::span<const LightPoint> light_points,
                        const ShadingPoint& point) {
  LightArrival arrival;
  if (light_points.empty())
    arrival.diffuse = arrival.glossy = seen.fraction;
  else
    arrival = arrival_from(light_points, point);
  arrival.visibility = seen;
  return arrival;
}

LightArrival arrival_from(std::span<const LightPoint> light_points, const ShadingPoint& point) {
  const bool glossy = point.is_glossy();
  const float nv = std::max(dot(point.normal, point.to_viewer), 1e-3f);
  const float f0 = luminance(point.specular);
  const float share = 1 / static_cast<float>(std::max<std::size_t>(light_points.size(), 1));
  Ratio diffuse, lobe;
  for (const LightPoint& p : light_points) {
    const float nl = dot(point.normal, p.direction);
    if (!(nl > 0)) continue;
    diffuse.add(p.weight * nl, p.visible);
    if (!glossy) continue;
    const Glossy g = ggx(widened_alpha2(point.alpha, p.weight * share), nv, nl,
                         dot(point.to_viewer, p.direction));
    lobe.add(p.weight * (f0 * g.f0 + g.f90), p.visible);
  }
  LightArrival arrival;
  arrival.diffuse = diffuse.value();
  arrival.glossy = glossy ? lobe.value() : arrival.diffuse;
  return arrival;
}

void tile_visibility(const Shadows& shadows, std::size_t light, std::span<const TilePoint> points,
                     std::span<const std::uint8_t> asked, int tile_width,
                     std::span<LightArrival> arrivals, std::vector<LightPoint>& scratch,
                     ShadowCounts& counts) {
  if (shadows.adaptive() && !is_point(shadows.lights().light(light)))
    return adaptive_visibility(shadows, light, points, asked, tile_width, arrivals, scratch,
                               counts);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (asked[i]) arrivals[i] = arrival_at(shadows, light, points[i], scratch, counts);
}

}  // namespace penumbra
