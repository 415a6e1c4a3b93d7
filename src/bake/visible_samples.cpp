#include "bake/visible_samples.h"

#include <algorithm>

#include "bake/surface_light.h"
#include "base/cancel.h"

namespace penumbra::bake {
namespace {

constexpr std::size_t batch = 4096;  // points

struct RayPoints {
  std::vector<SurfacePoint> points;
  std::vector<std::size_t> texels;
};

/// Those that the chart's own plane says nothing of.
RayPoints ray_points(const CutChart& chart, const WorldMesh& mesh,
                     std::span<const TexelPlace> places) {
  RayPoints out;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const TexelPlace& place = places[i];
    if (!place.is_used() || (chart.flat && place.is_inside())) continue;
    out.points.push_back(
        surface_point(mesh, {place.triangle, place.b1, place.b2, chart.shape.back}));
    out.texels.push_back(i);
  }
  return out;
}

void trace(const RayPoints& some, const SampledLight& light, const BakedIrradiance& irradiance,
           SampleBits& bits) {
  const std::size_t samples = light.samples.size();
  std::vector<std::uint8_t> seen;
  for (std::size_t first = 0; first < some.points.size(); first += batch) {
    throw_if_cancelled();
    const std::size_t count = std::min(batch, some.points.size() - first);
    seen.resize(count * samples);
    irradiance.visible_samples({some.points.data() + first, count}, light, seen);
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t s = 0; s < samples; ++s)
        bits.set(some.texels[first + k], s, seen[k * samples + s] != 0);
  }
}

}  // namespace

ChartSight chart_sight(const CutChart& chart, const WorldMesh& mesh,
                       const BakedIrradiance& irradiance, std::span<const TexelPlace> places) {
  ChartSight out;
  out.lights = irradiance.sampled_lights(chart.shape, !chart.flat);
  const RayPoints by_rays = ray_points(chart, mesh, places);
  for (const SampledLight& light : out.lights) {
    SampleBits& bits = out.bits.emplace_back(places.size(), light.samples.size());
    if (light.samples.empty()) continue;
    if (chart.flat) irradiance.visible_samples(chart.shape, light, bits);
    trace(by_rays, light, irradiance, bits);
  }
  return out;
}

}  // namespace penumbra::bake
