#include "render/direct_light.h"

#include <numbers>

#include "render/disk_irradiance.h"
#include "render/polygon_irradiance.h"
#include "render/segment_irradiance.h"

namespace penumbra {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float delta_sin2 = 1e-12f;  ///< below it a cone is one direction

void set_spot(const Light& light, float& scale, float& offset) {
  if (light.spot_cos_outer <= -1) return;
  scale = 1.0f / std::max(1e-4f, light.spot_cos_inner - light.spot_cos_outer);
  offset = -light.spot_cos_outer * scale;
}

/// A light so small that it does not widen the lobe by a thousandth.
bool one_lobe_is_enough(float solid_angle, float alpha) {
  return 0.25f * solid_angle < 1e-3f * alpha * alpha;
}

float smoothstep(float x) {
  const float s = std::clamp(x, 0.0f, 1.0f);
  return s * s * (3 - 2 * s);
}

/// Unit; `otherwise` at the light's centre itself.
Vec3 direction_or(const Vec3& to, const Vec3& otherwise) {
  const float d2 = dot(to, to);
  return d2 > 0 ? to / std::sqrt(d2) : otherwise;
}

/// Squared distance of a point light; what is nearer than a micrometre counts as that far.
float point_distance2(const Vec3& to) { return std::max(dot(to, to), 1e-12f); }

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

DirectLight::DirectLight(const LightViews& views) : spiral_(vogel_spiral(glossy_points)) {
  for (std::size_t i = 0; i < views.scene().lights.size(); ++i)
    lights_.push_back(source_of(views.light(i), views.mesh_light(i)));
}

DirectLight::Source DirectLight::source_of(const Light& light, const MeshLight& mesh) {
  Source s;
  s.type = light.type;
  s.emission = light.emission;
  s.position = light.position;
  s.normal = light.type == LightType::sun ? -light.direction : light.normal;
  s.radius = light.radius;
  s.double_sided = light.double_sided && !mesh.closed;
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
  if (light.type == LightType::mesh) add_mesh(mesh, s);
  return s;
}

void DirectLight::add_mesh(const MeshLight& mesh, Source& source) {
  source.patches = mesh_patches(mesh.faces, glossy_points);
  if (mesh.faces.size() > few_faces)
    source.fine_patches =
        mesh_patches(mesh.faces, mesh.is_textured ? textured_points : mesh_points);
  else
    source.faces = mesh.faces;
}

float DirectLight::spot_part(const Source& source, const Vec3& to_light) {
  return smoothstep(-dot(source.normal, to_light) * source.spot_scale + source.spot_offset);
}

float DirectLight::mesh_irradiance(const Source& source, const Vec3& position, const Vec3& normal,
                                   Horizon horizon) const {
  float sum = patches_irradiance(source.fine_patches, source.double_sided, position, normal);
  for (const LightFace& f : source.faces) {
    if (!source.double_sided && !MeshLight::turned(f, position)) continue;
    const std::array<Vec3, 3> seen{f.a - position, f.b - position, f.c - position};
    sum += f.brightness * polygon_irradiance(seen, normal, horizon);
  }
  return std::min(sum, pi);
}

float DirectLight::irradiance(std::size_t light, const Vec3& position, const Vec3& normal,
                              Horizon horizon) const {
  const Source& s = lights_[light];
  const Vec3 to = s.position - position;
  switch (s.type) {
    case LightType::point: {
      const float d2 = point_distance2(to), d = std::sqrt(d2);
      return spot_part(s, to / d) * std::max(0.0f, dot(normal, to)) / (d2 * d);
    }
    case LightType::sphere:
      return (s.spot_scale > 0 ? spot_part(s, direction_or(to, normal)) : 1.0f) *
             sphere_irradiance(to, s.radius, normal, horizon);
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
  const float nv = std::max(dot(n, v), 1e-3f);
  const float unit = source.type == LightType::sun ? source.per_radiance : 1.0f;
  const float one_minus_cos = sin2 / (1 + std::sqrt(1 - sin2));
  const float whole = 2 * pi * one_minus_cos;
  if (one_lobe_is_enough(whole, point.alpha))
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

float DirectLight::seen_solid_angle(const Source& source, const LightPatch& patch, const Vec3& to,
                                    float d2) {
  const float along = -dot(to, patch.normal);
  float facing = source.double_sided ? std::abs(along) : along;
  if (source.type == LightType::segment) facing = std::sqrt(std::max(0.0f, d2 - along * along));
  return facing > 0 ? patch_solid_angle(patch.area, facing, d2) : 0;
}

Glossy DirectLight::patch_glossy(const Source& source, const ShadingPoint& point) {
  const Vec3 &n = point.normal, &v = point.to_viewer;
  const float nv = std::max(dot(n, v), 1e-3f);
  float whole = 0;
  Vec3 middle;
  for (const LightPatch& patch : source.patches) {
    const Vec3 to = patch.position - point.position;
    const float d2 = std::max(dot(to, to), 1e-30f);
    const float solid_angle = dot(to, n) > 0 ? seen_solid_angle(source, patch, to, d2) : 0;
    whole += solid_angle;
    middle += to * (solid_angle / std::sqrt(d2));
  }
  if (!(whole > 0)) return {};
  const Vec3 mean = middle / whole;
  // A mean well below 1 in length: the light stands all round the point.
  if (one_lobe_is_enough(whole * source.stretch, point.alpha) && dot(mean, mean) > 0.9f) {
    const Vec3 l = normalize(mean);
    return ggx(widened_alpha2(point.alpha, whole), nv, dot(n, l), dot(v, l)) * whole;
  }
  Glossy sum;
  for (const LightPatch& patch : source.patches) {
    const Vec3 to = patch.position - point.position;
    const float d2 = std::max(dot(to, to), 1e-30f);
    const float solid_angle = seen_solid_angle(source, patch, to, d2);
    if (!(solid_angle > 0)) continue;
    const Vec3 l = to / std::sqrt(d2);
    sum +=
        ggx(widened_alpha2(point.alpha, solid_angle * source.stretch), nv, dot(n, l), dot(v, l)) *
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
    const Vec3 l = s.type == LightType::sun ? s.normal : direction_or(to, point.normal);
    const float strength = s.type == LightType::sun ? 1 : spot_part(s, l) / point_distance2(to);
    const float nv = std::max(dot(point.normal, point.to_viewer), 1e-3f);
    return ggx(point.alpha * point.alpha, nv, dot(point.normal, l), dot(point.to_viewer, l)) *
           strength;
  }
  if (s.type == LightType::sun) return cone_glossy(s, point, s.normal, s.sin2);
  if (s.type != LightType::sphere) return patch_glossy(s, point);
  const Vec3 axis = direction_or(to, point.normal);
  return cone_glossy(s, point, axis, d2 > 0 ? std::min(1.0f, s.radius * s.radius / d2) : 1.0f) *
         spot_part(s, axis);
}

}  // namespace penumbra
