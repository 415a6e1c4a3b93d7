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
    seen += visible ? x : 0.0f;
  }
  void add(float x, float part) {
    all += x;
    seen += x * part;
  }
  float value() const { return all > 0 ? seen / all : 0; }
};

/// Methods that answer with a visible fraction: all points that ask, at once.
void fractions(const Shadows& shadows, std::size_t light, std::span<const TilePoint> points,
               std::span<const std::uint8_t> asked, std::span<LightArrival> arrivals,
               ShadowCounts& counts) {
  thread_local std::vector<Receiver> receivers;
  thread_local std::vector<std::uint64_t> streams;
  thread_local std::vector<Visibility> seen;
  receivers.clear(), streams.clear();
  for (std::size_t i = 0; i < points.size(); ++i)
    if (asked[i]) receivers.push_back(points[i].receiver), streams.push_back(points[i].stream);
  seen.resize(receivers.size());
  shadows.visibilities(receivers, light, streams, seen, counts);
  std::size_t next = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!asked[i]) continue;
    const Visibility& v = seen[next++];
    arrivals[i] = {v.fraction, v.fraction, v};
  }
}

/// seen(i): of point i, whether it is, or which part of it.
template <class Seen>
LightArrival arrival_of_points(std::span<const LightPoint> light_points, const ShadingPoint& point,
                               const Seen& seen) {
  const bool glossy = point.is_glossy();
  const float nv = std::max(dot(point.normal, point.to_viewer), 1e-3f);
  const float f0 = luminance(point.specular);
  const float share = 1 / static_cast<float>(std::max<std::size_t>(light_points.size(), 1));
  Ratio diffuse, lobe;
  for (std::size_t i = 0; i < light_points.size(); ++i) {
    const LightPoint& p = light_points[i];
    const float nl = std::max(dot(point.normal, p.direction), 0.0f);
    diffuse.add(p.weight * nl, seen(i));
    if (!glossy || !(nl > 0)) continue;
    const Glossy g = ggx(widened_alpha2(point.alpha, p.weight * share), nv, nl,
                         dot(point.to_viewer, p.direction));
    lobe.add(p.weight * (f0 * g.f0 + g.f90), seen(i));
  }
  LightArrival arrival;
  arrival.diffuse = diffuse.value();
  arrival.glossy = glossy ? lobe.value() : arrival.diffuse;
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
  return arrival_of_points(light_points, point,
                           [&](std::size_t i) { return light_points[i].visible; });
}

LightArrival arrival_from(std::span<const LightPoint> light_points, std::span<const float> seen,
                          const ShadingPoint& point) {
  return arrival_of_points(light_points, point, [&](std::size_t i) { return seen[i]; });
}

void tile_visibility(const Shadows& shadows, std::size_t light, std::span<const TilePoint> points,
                     std::span<const std::uint8_t> asked, int tile_width,
                     std::span<LightArrival> arrivals, std::vector<LightPoint>& scratch,
                     ShadowCounts& counts) {
  if (shadows.adaptive() && !is_point(shadows.lights().light(light)))
    return adaptive_visibility(shadows, light, points, asked, tile_width, arrivals, scratch,
                               counts);
  if (!shadows.sums_light_points())
    return fractions(shadows, light, points, asked, arrivals, counts);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!asked[i]) continue;
    const TilePoint& p = points[i];
    const Visibility seen = shadows.light_points(p.receiver, light, p.stream, scratch, counts);
    arrivals[i] = arrival_of(seen, scratch, p.shading);
  }
}

}  // namespace penumbra
