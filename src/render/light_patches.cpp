#include "render/light_patches.h"

#include <numbers>

namespace penumbra {
namespace {

/// Uniform in a triangle from the unit square (Heitz 2019, A Low-Distortion Map Between Triangle
/// and Square).
Vec3 in_triangle(const LightFace& t, float x, float y) {
  const float b1 = y > x ? 0.5f * x : x - 0.5f * y;
  const float b2 = y > x ? y - 0.5f * x : 0.5f * y;
  return t.a + (t.b - t.a) * b1 + (t.c - t.a) * b2;
}

float fraction(double x) { return static_cast<float>(x - std::floor(x)); }

}  // namespace

std::vector<Vec2> vogel_spiral(int count) {
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double r = std::sqrt((i + 0.5) / count), phi = i * golden_angle;
    points.push_back(
        {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi))});
  }
  return points;
}

std::vector<LightPatch> disk_patches(const Light& light, int count) {
  const Frame frame = frame_around(light.normal);
  const float area = std::numbers::pi_v<float> * light.radius * light.radius;
  std::vector<LightPatch> patches;
  for (const Vec2& p : vogel_spiral(count))
    patches.push_back({light.position + (frame.u * p.x + frame.v * p.y) * light.radius,
                       light.normal, area / static_cast<float>(count)});
  return patches;
}

std::vector<LightPatch> rect_patches(const Light& light, int count) {
  const float lu = length(light.edge_u), lv = length(light.edge_v);
  if (!(lu > 0) || !(lv > 0)) return {};
  const float across = std::sqrt(static_cast<float>(count) * lu / lv);
  const int nu = std::clamp(static_cast<int>(std::lround(across)), 1, count);
  const int nv = std::max(1, count / nu);
  const float area = length(cross(light.edge_u, light.edge_v)) / static_cast<float>(nu * nv);
  std::vector<LightPatch> patches;
  patches.reserve(nu * nv);
  for (int i = 0; i < nu * nv; ++i) {
    const int row = i / nu;
    const float u = (static_cast<float>(i % nu) + 0.5f) / static_cast<float>(nu) - 0.5f;
    const float v = (static_cast<float>(row) + 0.5f) / static_cast<float>(nv) - 0.5f;
    patches.push_back({light.position + light.edge_u * u + light.edge_v * v, light.normal, area});
  }
  return patches;
}

std::vector<LightPatch> segment_patches(const Light& light, int count) {
  const float size = length(light.edge_u), step = 1.0f / static_cast<float>(count);
  if (!(size > 0)) return {};
  std::vector<LightPatch> patches;
  patches.reserve(count);
  for (int i = 0; i < count; ++i)
    patches.push_back(
        {light.position + light.edge_u * ((static_cast<float>(i) + 0.5f) * step - 0.5f),
         light.edge_u / size, 2 * light.radius * size * step});
  return patches;
}

std::vector<LightPatch> mesh_patches(std::span<const LightFace> faces, int count) {
  double total = 0;
  for (const LightFace& f : faces) total += f.area;
  std::vector<LightPatch> patches;
  const double share = total / count;
  double passed = 0;
  for (const LightFace& f : faces) {
    passed += f.area;
    for (auto i = patches.size(); static_cast<double>(i) + 0.5 < passed / share; ++i)
      patches.push_back({in_triangle(f, fraction(0.5 + 0.7548776662 * static_cast<double>(i)),
                                     fraction(0.5 + 0.5698402910 * static_cast<double>(i))),
                         f.normal, static_cast<float>(share)});
  }
  return patches;
}

}  // namespace penumbra
