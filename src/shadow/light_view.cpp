#include "shadow/light_view.h"

#include <cmath>
#include <numbers>

namespace penumbra {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

float disk_diameter(float area) { return 2 * std::sqrt(area / pi); }

void set_plane(LightView& view, const Vec3& normal, const Vec3& center, const Vec3& point) {
  const float d = dot(normal, point - center);
  view.flat = true;
  view.plane_normal = d < 0 ? -normal : normal;
  view.plane_distance = std::abs(d);
}

}  // namespace

float diameter_of(const Light& light) {
  switch (light.type) {
    case LightType::sphere:
    case LightType::disk:
      return 2 * light.radius;
    case LightType::rect:
      return disk_diameter(length(cross(light.edge_u, light.edge_v)));
    case LightType::segment:
      return disk_diameter(2 * light.radius * length(light.edge_u));
    case LightType::sun:
      return 2 * std::tan(light.angular_diameter / 2);
    default:
      return 0;
  }
}

bool is_point(const Light& light) {
  switch (light.type) {
    case LightType::point:
      return true;
    case LightType::sun:
      return light.angular_diameter == 0;
    case LightType::sphere:
      return light.radius == 0;
    default:
      return false;
  }
}

LightViews::LightViews(const Scene& scene) : scene_(scene), meshes_(scene.lights.size()) {
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    if (scene.lights[i].type == LightType::mesh) meshes_[i] = MeshLight(scene, scene.lights[i]);
}

std::size_t LightViews::pattern_of(std::size_t i) const {
  if (!meshes_[i].is_textured) return i;
  const int first =
      scene_.instances[static_cast<std::size_t>(scene_.lights[i].instance)].mesh_light;
  return first < 0 ? i : static_cast<std::size_t>(first);
}

std::optional<LightView> LightViews::view(std::size_t index, const Vec3& point) const {
  const Light& light = scene_.lights[index];
  LightView view;
  if (light.type == LightType::sun) {
    view.direction = -light.direction;
    view.diameter_over_distance = diameter_of(light);
    return view;
  }
  if (light.type == LightType::mesh) return mesh_view(index, point);
  const Vec3 to_light = light.position - point;
  view.distance = length(to_light);
  if (!(view.distance > 0)) return std::nullopt;
  view.direction = to_light / view.distance;
  view.diameter_over_distance = diameter_of(light) / view.distance;
  if (light.type == LightType::disk || light.type == LightType::rect)
    set_plane(view, light.normal, light.position, point);
  return view;
}

std::optional<LightView> LightViews::mesh_view(std::size_t index, const Vec3& point) const {
  const MeshLight& mesh = meshes_[index];
  const auto [area, moment] = mesh.seen_from(point, scene_.lights[index].double_sided);
  if (!(area > 0)) return std::nullopt;
  LightView view;
  const Vec3 to_light = moment / area - point;
  view.distance = length(to_light);
  if (!(view.distance > 0)) return std::nullopt;
  view.direction = to_light / view.distance;
  view.diameter_over_distance = disk_diameter(area) / view.distance;
  view.own_instance = scene_.lights[index].instance;
  if (mesh.flat) set_plane(view, mesh.faces.front().normal, mesh.faces.front().a, point);
  return view;
}

}  // namespace penumbra
