#include "render/point_shader.h"

#include <numbers>

namespace penumbra {

Horizon horizon_of(const Shadows& shadows) {
  const ShadowKind kind = shadows.options().kind;
  return kind == ShadowKind::hard || kind == ShadowKind::parker ? Horizon::centre : Horizon::exact;
}

void PointShader::find_unshadowed(const DirectLight& lights, std::size_t light, Horizon horizon,
                                  bool ask_all, std::span<const TilePoint> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ShadingPoint& p = points[i].shading;
    Unshadowed u;
    if (p.is_diffuse()) u.irradiance = lights.irradiance(light, p.position, p.normal, horizon);
    // A light that gives no irradiance is below the horizon or turned away.
    if (p.is_glossy() && (u.irradiance > 0 || !p.is_diffuse())) u.glossy = lights.glossy(light, p);
    unshadowed_[i] = u;
    asked_[i] = ask_all || u.irradiance > 0 || u.glossy.f0 > 0 || u.glossy.f90 > 0;
  }
}

void PointShader::look_up(const KnownLight& known, std::size_t light,
                          std::span<const TilePoint> points) {
  irradiances_.resize(points.size()), fractions_.resize(points.size());
  known.irradiances(light, points, irradiances_);
  known.visible_fractions(light, points, fractions_);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float unshadowed = unshadowed_[i].irradiance;
    float part = unshadowed > 0 ? irradiances_[i] / unshadowed : 0;
    if (irradiances_[i] < 0) part = 1;
    const float fraction = fractions_[i] < 0 ? std::min(part, 1.0f) : fractions_[i];
    arrivals_[i] = {part, fraction, {fraction, 0}};
  }
}

void PointShader::add(const Vec3& emission, std::span<const TilePoint> points,
                      std::vector<Vec3>& radiance) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!asked_[i]) continue;
    const ShadingPoint& p = points[i].shading;
    const Unshadowed& u = unshadowed_[i];
    const Vec3 diffuse =
        p.diffuse * (u.irradiance * std::numbers::inv_pi_v<float> * arrivals_[i].diffuse);
    const Vec3 glossy = (p.specular * u.glossy.f0 + Vec3(u.glossy.f90)) * arrivals_[i].glossy;
    radiance[i] += emission * (diffuse + glossy);
  }
}

void PointShader::shade(const DirectLight& lights, const Shadows& shadows, const KnownLight* known,
                        const Vec3& ambient, std::span<const TilePoint> points, int tile_width,
                        std::vector<Vec3>& radiance, ArrivalObserver* observer,
                        ShadowCounts& counts) {
  const std::size_t count = points.size();
  unshadowed_.resize(count);
  asked_.resize(count);
  arrivals_.resize(count);
  radiance.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    radiance[i] = ambient * (points[i].shading.diffuse + points[i].shading.specular);
  for (std::size_t light = 0; light < lights.size(); ++light) {
    find_unshadowed(lights, light, horizon_of(shadows), observer != nullptr, points);
    if (known) {
      if (!known->arrivals(light, points, asked_, arrivals_)) look_up(*known, light, points);
    } else {
      tile_visibility(shadows, light, points, asked_, tile_width, arrivals_, light_points_, counts);
    }
    add(lights.emission(light), points, radiance);
    if (observer) observer->arrived(light, points, arrivals_);
  }
}

}  // namespace penumbra
