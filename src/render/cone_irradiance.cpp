#include "render/cone_irradiance.h"

#include <numbers>

namespace penumbra {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// The cone crosses the horizon: |cos_centre| < sin. In double because for a small cone the terms
/// are 1 / sin² times larger than what is left of them.
float crossing(double cos_centre, double sin2) {
  const double sin_centre = std::sqrt(std::max(0.0, 1.0 - cos_centre * cos_centre));
  const double cot = std::sqrt((1.0 - sin2) / sin2);
  const double y = std::clamp(-cot * cos_centre / sin_centre, -1.0, 1.0);
  const double half_chord = sin_centre * std::sqrt(1.0 - y * y);
  const double e =
      sin2 * (cos_centre * std::acos(y) - cot * half_chord) + std::atan2(half_chord, cot);
  return static_cast<float>(std::max(e, 0.0));
}

}  // namespace

float cone_irradiance(float cos_centre, float sin2, Horizon horizon) {
  const bool whole = cos_centre * cos_centre >= sin2;
  if (whole || horizon == Horizon::centre) return pi * sin2 * std::max(cos_centre, 0.0f);
  return crossing(cos_centre, sin2);
}

float sphere_irradiance(const Vec3& center, float radius, const Vec3& normal, Horizon horizon) {
  const float d2 = dot(center, center), r2 = radius * radius;
  if (!(d2 > 0)) return r2 > 0 ? pi : 0;
  const float cos_centre = std::clamp(dot(normal, center) / std::sqrt(d2), -1.0f, 1.0f);
  return cone_irradiance(cos_centre, std::min(1.0f, r2 / d2), horizon);
}

}  // namespace penumbra
