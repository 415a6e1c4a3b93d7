#include "render/exposure.h"

#include "render/hash.h"
#include "render/tile_renderer.h"

namespace penumbra {
namespace {

constexpr double percentile = 0.9, shown_as = 0.8;
constexpr float ambient_share = 0.12f;

std::vector<TileRay> grid_rays(const CameraRays& camera) {
  std::vector<TileRay> rays;
  for (int y = 0; y < exposure_grid_height; ++y)
    for (int x = 0; x < exposure_grid_width; ++x) {
      TileRay ray;
      ray.beam = camera.at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      ray.pixel = static_cast<std::uint32_t>(rays.size());
      ray.stream = mix64(ray.pixel);
      rays.push_back(ray);
    }
  return rays;
}

/// EV for a set of luminances; nothing for an empty or black one.
std::optional<float> exposure_for(std::vector<float> luminances) {
  if (luminances.empty()) return {};
  const auto rank =
      static_cast<std::ptrdiff_t>(percentile * static_cast<double>(luminances.size() - 1));
  std::nth_element(luminances.begin(), luminances.begin() + rank, luminances.end());
  const float bright = luminances[static_cast<std::size_t>(rank)];
  if (!(bright > 0) || !std::isfinite(bright)) return {};
  return static_cast<float>(std::log2(shown_as / double(bright)));
}

SeenLuminances look(const World& world, const CameraRays& camera, const DirectLight& lights,
                    const MaterialLookup& materials, const Vec3& ambient) {
  ShadowOptions hard;
  hard.kind = ShadowKind::hard;
  const Shadows shadows(world, hard);
  std::vector<TilePoint> points;
  std::vector<Vec3> radiance;
  ShadowCounts counts;
  trace(world, materials, grid_rays(camera), points);
  PointShader().shade(lights, shadows, nullptr, ambient, points, exposure_grid_width, radiance,
                      nullptr, counts);
  SeenLuminances seen;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ShadingPoint& p = points[i].shading;
    const Vec3 unlit = ambient * (p.diffuse + p.specular);
    if (max_component(p.emission) > 0) {
      seen.emission.push_back(luminance(p.emission));
      continue;
    }
    if (!p.is_diffuse() && !p.is_glossy()) continue;
    seen.all.push_back(luminance(radiance[i]));
    if (radiance[i] != unlit) seen.lit.push_back(luminance(radiance[i]));
  }
  return seen;
}

float exposure_under(const World& world, const CameraRays& camera, const DirectLight& lights,
                     const MaterialLookup& materials, const Vec3& ambient) {
  return exposure_from(look(world, camera, lights, materials, ambient), world.scene().background);
}

}  // namespace

float exposure_from(const SeenLuminances& seen, const Vec3& background) {
  const bool enough_lit = seen.lit.size() * 100 >= seen.all.size();
  const auto by_surfaces = exposure_for(enough_lit && !seen.lit.empty() ? seen.lit : seen.all);
  if (by_surfaces) return *by_surfaces;
  if (const auto ev = exposure_for({luminance(background)})) return *ev;
  return exposure_for(seen.emission).value_or(0.0f);
}

Vec3 automatic_ambient(float exposure_ev) {
  return Vec3(ambient_share * static_cast<float>(shown_as) * std::exp2(-exposure_ev));
}

Brightness find_brightness(const World& world, const CameraRays& camera, const DirectLight& lights,
                           const MaterialLookup& materials) {
  const Scene& scene = world.scene();
  const Vec3 ambient = scene.ambient_is_automatic ? Vec3() : scene.ambient;
  const float ev = exposure_under(world, camera, lights, materials, ambient);
  if (!scene.ambient_is_automatic) return {ev, scene.ambient};
  return {ev, automatic_ambient(ev)};
}

}  // namespace penumbra
