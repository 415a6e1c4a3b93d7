#include "render/direct_light.h"

#include <numbers>

#include "render/disk_irradiance.h"
#include "render/polygon_irradiance.h"
#include "render/segment_irradiance.h"

namespace penumbra {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr int glossy_points = 32;
constexpr int mesh_points = 128;
constexpr std::size_t few_triangles = 64;
constexpr float delta_sin2 = 1e-12f;  ///< below it a cone is one direction

std::vector<WorldTriangle> world_triangles(const Scene& scene, const Instance& instance) {
  const Mesh& mesh = scene.meshes[instance.mesh];
  const Affine& m = instance.world_from_mesh;
  const bool mirrored = m.determinant() < 0;
  std::vector<WorldTriangle> triangles;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return m.point(mesh.positions[mesh.indices[i + k]]); };
    triangles.push_back({at(0), at(mirrored ? 2 : 1), at(mirrored ? 1 : 2)});
  }
  return triangles;
}

/// What tells a closed surface from an open one, and its inside from its outside.
struct Closure {
  Vec3d vector_area;
  double area = 0, volume = 0;

  bool closed() const { return length(vector_area) < 1e-3 * area; }
};

Closure closure_of(const std::vector<WorldTriangle>& triangles) {
  Closure sum;
  if (triangles.empty()) return sum;
  const Vec3d origin(triangles[0].a);
  for (const WorldTriangle& t : triangles) {
    const Vec3d a = Vec3d(t.a) - origin, b = Vec3d(t.b) - origin, c = Vec3d(t.c) - origin;
    const Vec3d n = cross(b - a, c - a) * 0.5;
    sum.vector_area += n;
    sum.area += length(n);
    sum.volume += dot(a, n) / 3;
  }
  return sum;
}

void set_spot(const Light& light, float& scale, float& offset) {
  if (light.spot_cos_outer <= -1) return;
  scale = 1.0f / std::max(1e-4f, light.spot_cos_inner - light.spot_cos_outer);
  offset = -light.spot_cos_outer * scale;
}

float smoothstep(float x) {
  const float s = std::clamp(x, 0.0f, 1.0f);
  return s * s * (3 - 2 * s);
}

/// Solid angle of a patch of `area` that is turned by `facing` (cosine times distance), seen from
/// distance² `d2`; near it bounded by the half space of the disk of its area.
float patch_solid_angle(float area, float facing, float d2) {
  return area * facing / (std::sqrt(d2) * (d2 + area / pi));
}

float patches_irradiance(const std::vector<LightPatch>& patches, bool double_sided,
                         const Vec3& position, const Vec3& normal) {
  float sum = 0;
  for (const LightPatch& patch : patches) {
    const Vec3 to = patch.position - position;
    const float d2 = dot(to, to), up = dot(to, normal), back = -dot(to, patch.normal);
    const float facing = double_sided ? std::abs(back) : back;
    if (up > 0 && facing > 0) sum += patch_solid_angle(patch.area, facing, d2) * up / std::sqrt(d2);
  }
  return sum;
}

}  // namespace

DirectLight::DirectLight(const Scene& scene) : spiral_(vogel_spiral(glossy_points)) {
  for (const Light& light : scene.lights) lights_.push_back(source_of(scene, light));
}

DirectLight::Source DirectLight::source_of(const Scene& scene, const Light& light) const {
  Source s;
  s.type = light.type;
  s.emission = light.emission;
  s.position = light.position;
  s.normal = light.type == LightType::sun ? -light.direction : light.normal;
  s.radius = light.radius;
  s.double_sided = light.double_sided;
  const Vec3 u = light.edge_u * 0.5f, v = light.edge_v * 0.5f, p = light.position;
  const float sine = std::sin(0.5f * light.angular_diameter);
  s.sin2 = sine * sine;
  s.per_radiance = 1 / (pi * std::max(s.sin2, delta_sin2));
  set_spot(light, s.spot_scale, s.spot_offset);
  if (light.type == LightType::disk) s.patches = disk_patches(light, glossy_points);
  if (light.type == LightType::rect) {
    s.patches = rect_patches(light, glossy_points);
    s.corners = {p - u - v, p + u - v, p + u + v, p - u + v};
  }
  if (light.type == LightType::segment) {
    s.patches = segment_patches(light, glossy_points);
    s.corners = {p - u, p + u};
    if (light.radius > 0)
      s.stretch = std::max(1.0f, length(light.edge_u) / (glossy_points * 2 * light.radius));
  }
  if (light.type == LightType::mesh) add_mesh(scene, light, s);
  return s;
}

void DirectLight::add_mesh(const Scene& scene, const Light& light, Source& source) const {
  if (light.instance < 0) return;
  auto triangles =
      world_triangles(scene, scene.instances[static_cast<std::size_t>(light.instance)]);
  const Closure closure = closure_of(triangles);
  if (source.double_sided && closure.closed()) {
    source.double_sided = false;
    if (closure.volume < 0)
      for (WorldTriangle& t : triangles) std::swap(t.b, t.c);
  }
  source.patches = mesh_patches(triangles, glossy_points);
  if (triangles.size() > few_triangles)
    source.fine_patches = mesh_patches(triangles, mesh_points);
  else
    source.triangles = std::move(triangles);
}

float DirectLight::mesh_irradiance(const Source& source, const Vec3& position, const Vec3& normal,
                                   Horizon horizon) const {
  float sum = patches_irradiance(source.fine_patches, source.double_sided, position, normal);
  for (const WorldTriangle& t : source.triangles) {
    const std::array<Vec3, 3> seen{t.a - position, t.b - position, t.c - position};
    const bool behind = dot(cross(t.b - t.a, t.c - t.a), seen[0]) >= 0;
    if (!behind || source.double_sided) sum += polygon_irradiance(seen, normal, horizon);
  }
  return std::min(sum, pi);
}

float DirectLight::irradiance(std::size_t light, const Vec3& position, const Vec3& normal,
                              Horizon horizon) const {
  const Source& s = lights_[light];
  const Vec3 to = s.position - position;
  switch (s.type) {
    case LightType::point: {
      const float d2 = dot(to, to), d = std::sqrt(d2);
      if (!(d2 > 0)) return 0;
      const float spot = smoothstep(-dot(s.normal, to) / d * s.spot_scale + s.spot_offset);
      return spot * std::max(0.0f, dot(normal, to)) / (d2 * d);
    }
    case LightType::sphere:
      return sphere_irradiance(to, s.radius, normal, horizon);
    case LightType::sun: {
      const float cos_centre = dot(normal, s.normal);
      if (s.sin2 < delta_sin2) return std::max(0.0f, cos_centre);
      return s.per_radiance * cone_irradiance(cos_centre, s.sin2, horizon);
    }
    case LightType::disk:
      return disk_irradiance({to, s.normal, s.radius}, normal, horizon);
    case LightType::segment:
      return segment_irradiance(s.corners[0] - position, s.corners[1] - position, s.radius, normal,
                                horizon);
    case LightType::rect: {
      if (dot(s.normal, to) >= 0) return 0;
      const std::array<Vec3, 4> seen{s.corners[0] - position, s.corners[1] - position,
                                     s.corners[2] - position, s.corners[3] - position};
      return polygon_irradiance(seen, normal, horizon);
    }
    case LightType::mesh:
      return mesh_irradiance(s, position, normal, horizon);
  }
  return 0;
}

Glossy DirectLight::cone_glossy(const Source& source, const ShadingPoint& point, const Vec3& axis,
                                float sin2) const {
  const Vec3 &n = point.normal, &v = point.to_viewer;
  const float nv = std::max(dot(n, v), 1e-3f), alpha2 = point.alpha * point.alpha;
  const float unit = source.type == LightType::sun ? source.per_radiance : 1.0f;
  const float one_minus_cos = sin2 / (1 + std::sqrt(1 - sin2));
  const float whole = 2 * pi * one_minus_cos;
  if (0.25f * whole < 1e-3f * alpha2)
    return ggx(widened_alpha2(point.alpha, whole), nv, dot(n, axis), dot(v, axis)) * (whole * unit);
  // The set is turned with the mirrored viewer, so that it has no seam of its own.
  const Vec3 mirrored = n * (2 * dot(n, v)) - v, aside = mirrored - axis * dot(mirrored, axis);
  const Vec3 u = dot(aside, aside) > 1e-10f ? normalize(aside) : frame_around(axis).u;
  const Vec3 w = cross(axis, u);
  const float share = whole / static_cast<float>(spiral_.size());
  const float wide = widened_alpha2(point.alpha, share);
  const float na = dot(n, axis), nu = dot(n, u), nw = dot(n, w);
  const float va = dot(v, axis), vu = dot(v, u), vw = dot(v, w);
  Glossy sum;
  for (const Vec2& p : spiral_) {
    const float away = (p.x * p.x + p.y * p.y) * one_minus_cos;
    const float k = std::sqrt(one_minus_cos * (2 - away));
    const float x = k * p.x, y = k * p.y, z = 1 - away;
    sum += ggx(wide, nv, na * z + nu * x + nw * y, va * z + vu * x + vw * y);
  }
  return sum * (share * unit);
}

Glossy DirectLight::patch_glossy(const Source& source, const ShadingPoint& point) const {
  const float nv = std::max(dot(point.normal, point.to_viewer), 1e-3f);
  Glossy sum;
  for (const LightPatch& patch : source.patches) {
    const Vec3 to = patch.position - point.position;
    const float d2 = dot(to, to), along = -dot(to, patch.normal);
    const bool strip = source.type == LightType::segment;
    const float facing = strip                 ? std::sqrt(std::max(0.0f, d2 - along * along))
                         : source.double_sided ? std::abs(along)
                                               : along;
    if (!(facing > 0) || !(dot(to, point.normal) > 0)) continue;
    const Vec3 l = to / std::sqrt(d2);
    const float solid_angle = patch_solid_angle(patch.area, facing, d2);
    sum += ggx(widened_alpha2(point.alpha, solid_angle * source.stretch), nv, dot(point.normal, l),
               dot(point.to_viewer, l)) *
           solid_angle;
  }
  return sum;
}

Glossy DirectLight::glossy(std::size_t light, const ShadingPoint& point) const {
  const Source& s = lights_[light];
  const Vec3 to = s.position - point.position;
  const float d2 = dot(to, to);
  const bool is_delta =
      s.type == LightType::point || (s.type == LightType::sun && s.sin2 < delta_sin2);
  if (is_delta) {
    const Vec3 l = s.type == LightType::sun ? s.normal : d2 > 0 ? to / std::sqrt(d2) : point.normal;
    const float spot = smoothstep(-dot(s.normal, l) * s.spot_scale + s.spot_offset);
    const float strength = s.type == LightType::sun ? 1 : d2 > 0 ? spot / d2 : 0;
    const float nv = std::max(dot(point.normal, point.to_viewer), 1e-3f);
    return ggx(point.alpha * point.alpha, nv, dot(point.normal, l), dot(point.to_viewer, l)) *
           strength;
  }
  if (s.type == LightType::sun) return cone_glossy(s, point, s.normal, s.sin2);
  if (s.type != LightType::sphere) return patch_glossy(s, point);
  const Vec3 axis = d2 > 0 ? to / std::sqrt(d2) : point.normal;
  return cone_glossy(s, point, axis, d2 > 0 ? std::min(1.0f, s.radius * s.radius / d2) : 1.0f);
}

}  // namespace penumbra
