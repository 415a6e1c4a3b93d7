#include "bake/surface_light.h"

#include <numbers>

namespace penumbra::bake {
namespace {

template <class Values>
auto mix(const Values& values, const WorldMesh& mesh, const MeshPoint& at) {
  const auto &a = values[mesh.vertex(at.triangle, 0)], &b = values[mesh.vertex(at.triangle, 1)],
             &c = values[mesh.vertex(at.triangle, 2)];
  const float w = 1 - at.b1 - at.b2;
  if constexpr (requires { a.z; })
    return a * w + b * at.b1 + c * at.b2;
  else
    return Vec2{a.x * w + b.x * at.b1 + c.x * at.b2, a.y * w + b.y * at.b1 + c.y * at.b2};
}

float uv_per_metre(const std::vector<Vec2>& uv, const WorldMesh& mesh, std::uint32_t t) {
  const Vec2 &a = uv[mesh.vertex(t, 0)], &b = uv[mesh.vertex(t, 1)], &c = uv[mesh.vertex(t, 2)];
  const float doubled = std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  return mesh.area(t) > 0 ? std::sqrt(doubled / (2 * mesh.area(t))) : 0.0f;
}

}  // namespace

SurfacePoint surface_point(const WorldMesh& mesh, const MeshPoint& at) {
  const float side = at.back ? -1.0f : 1.0f;
  SurfacePoint point;
  point.position = mix(mesh.positions(), mesh, at);
  point.normal = mesh.normal(at.triangle) * side;
  point.shading_normal = point.normal;
  point.instance = mesh.index();
  point.triangle = at.triangle;
  if (!mesh.is_smooth(at.triangle)) return point;
  const Vec3 n =
      (mesh.corner_normal(at.triangle, 0) * (1 - at.b1 - at.b2) +
       mesh.corner_normal(at.triangle, 1) * at.b1 + mesh.corner_normal(at.triangle, 2) * at.b2) *
      side;
  const float size = length(n);
  if (size > 0.33f && dot(n, point.normal) >= 0.33f * size) point.shading_normal = n / size;
  return point;
}

Surface SurfaceLight::surface(const WorldMesh& mesh, const MeshPoint& at) const {
  const SurfacePoint point = surface_point(mesh, at);
  Surface s;
  s.position = s.smooth_position = point.position;
  s.normal = point.normal;
  s.shading_normal = point.shading_normal;
  float* per_metre[] = {&s.uv_per_metre.x, &s.uv_per_metre.y};
  for (int set = 0; set < 2; ++set) {
    const std::vector<Vec2>& uv = mesh.mesh().uv[set];
    if (uv.empty()) continue;
    s.uv[set] = mix(uv, mesh, at);
    *per_metre[set] = uv_per_metre(uv, mesh, at.triangle);
  }
  if (!mesh.mesh().colors.empty()) s.color = mix(mesh.mesh().colors, mesh, at);
  s.material = mesh.instance().material;
  s.object = mesh.instance().object;
  s.front = !at.back;
  return s;
}

Vec3 SurfaceLight::radiance(const WorldMesh& mesh, const MeshPoint& at, const Vec3& irradiance,
                            float width) const {
  const Surface s = surface(mesh, at);
  const ShadingPoint p = materials_.at(s, s.normal, width);
  return p.diffuse * irradiance * std::numbers::inv_pi_v<float> +
         ambient_ * (p.diffuse + p.specular) + p.emission;
}

float SurfaceLight::alpha(const WorldMesh& mesh, const MeshPoint& at) const {
  const Material& m = scene_.materials[mesh.instance().material];
  if (!m.alpha_cutoff) return 1;
  const TextureSlot& slot = m.diffuse_map;
  if (!slot.used() || mesh.mesh().uv[slot.uv_set].empty()) return m.alpha;
  return m.alpha * sample_alpha(scene_.textures[static_cast<std::size_t>(slot.image)], slot,
                                mix(mesh.mesh().uv[slot.uv_set], mesh, at));
}

}  // namespace penumbra::bake
