#include "render/polygon_irradiance.h"

#include <array>

namespace penumbra {
namespace {

/// Θ Γ · n of one edge. Written with the cross product of the vertices as they are, so that a
/// distant small polygon loses no digits to normalisation.
float edge_term(const Vec3& a, const Vec3& b, const Vec3& normal) {
  const Vec3 c = cross(a, b - a);
  const float sine2 = dot(c, c);
  if (!(sine2 > 0)) return 0;
  const float sine = std::sqrt(sine2);
  return dot(c, normal) * (std::atan2(sine, dot(a, b)) / sine);
}

float contour(std::span<const Vec3> v, const Vec3& normal) {
  float sum = 0;
  for (std::size_t i = 0, j = v.size() - 1; i < v.size(); j = i++)
    sum += edge_term(v[j], v[i], normal);
  return 0.5f * sum;
}

/// The part with n · p ≥ 0 (Sutherland and Hodgman 1974); one vertex more than before at most.
std::size_t clip(std::span<const Vec3> v, const Vec3& normal, std::array<Vec3, 9>& out) {
  std::size_t count = 0;
  Vec3 a = v.back();
  float ha = dot(a, normal);
  for (const Vec3& b : v) {
    const float hb = dot(b, normal);
    if ((ha < 0) != (hb < 0)) out[count++] = a + (b - a) * (ha / (ha - hb));
    if (hb >= 0) out[count++] = b;
    a = b, ha = hb;
  }
  return count;
}

/// The contour's sense: its vector irradiance points along or against the direction to it.
float sense(std::span<const Vec3> v) {
  return dot(v[0], cross(v[1] - v[0], v[2] - v[0])) < 0 ? -1.0f : 1.0f;
}

}  // namespace

float polygon_irradiance(std::span<const Vec3> vertices, const Vec3& normal, Horizon horizon) {
  bool above = false, below = false;
  for (const Vec3& v : vertices) (dot(v, normal) >= 0 ? above : below) = true;
  if (!above) return 0;
  if (!below || horizon == Horizon::centre)
    return std::max(0.0f, sense(vertices) * contour(vertices, normal));
  std::array<Vec3, 9> kept;
  const std::size_t count = clip(vertices, normal, kept);
  return count < 3 ? 0.0f : std::abs(contour({kept.data(), count}, normal));
}

}  // namespace penumbra
