#include "shadow/light_view.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>

namespace penumbra {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

float disk_diameter(float area) { return 2 * std::sqrt(area / pi); }

std::array<float, 3> key(const Vec3& p) { return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; }

bool is_closed(const Mesh& mesh) {
  using Edge = std::pair<std::array<float, 3>, std::array<float, 3>>;
  std::map<Edge, int> balance;  // +1 one way, −1 the other
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    const auto a = key(mesh.positions[mesh.indices[i]]);
    const auto b = key(mesh.positions[mesh.indices[next]]);
    balance[std::minmax(a, b)] += a < b ? 1 : -1;
  }
  return std::all_of(balance.begin(), balance.end(), [](const auto& e) { return e.second == 0; });
}

bool is_flat(const std::vector<LightFace>& faces) {
  if (faces.empty()) return false;
  Bounds bounds;
  for (const LightFace& f : faces)
    for (const Vec3& p : {f.a, f.b, f.c}) bounds.grow(p);
  const float slack = 1e-5f * bounds.diagonal();
  const LightFace& first = faces.front();
  return std::all_of(faces.begin(), faces.end(), [&](const LightFace& f) {
    const auto off = [&](const Vec3& p) {
      return std::abs(dot(first.normal, p - first.a)) > slack;
    };
    return dot(f.normal, first.normal) > 0.999f && !off(f.a) && !off(f.b) && !off(f.c);
  });
}

MeshLight mesh_light_of(const Scene& scene, const Light& light) {
  MeshLight out;
  const Instance& instance = scene.instances[static_cast<std::size_t>(light.instance)];
  const Mesh& mesh = scene.meshes[instance.mesh];
  const float side = instance.world_from_mesh.determinant() < 0 ? -1.0f : 1.0f;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto corner = [&](std::size_t i) {
      return instance.world_from_mesh.point(mesh.positions[mesh.indices[3 * t + i]]);
    };
    LightFace face{corner(0), corner(1), corner(2), {}, 0};
    const Vec3 n = cross(face.b - face.a, face.c - face.a);
    const float len = length(n);
    if (!(len > 0)) continue;
    face.normal = n * (side / len);
    face.area = len / 2;
    out.faces.push_back(face);
  }
  double sum = 0;
  for (const LightFace& f : out.faces)
    out.areas.push_back(static_cast<float>(sum += double(f.area)));
  out.flat = is_flat(out.faces);
  out.closed = is_closed(mesh);
  return out;
}

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

bool MeshLight::takes_all(const Vec3& point, bool double_sided) const {
  if (double_sided && !closed) return true;
  return std::none_of(faces.begin(), faces.end(),
                      [&](const LightFace& f) { return turned(f, point); });
}

LightViews::LightViews(const Scene& scene) : scene_(scene), meshes_(scene.lights.size()) {
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    if (scene.lights[i].type == LightType::mesh) meshes_[i] = mesh_light_of(scene, scene.lights[i]);
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
  const bool all = mesh.takes_all(point, scene_.lights[index].double_sided);
  Vec3 center;
  float area = 0;
  for (const LightFace& f : mesh.faces) {
    if (!all && !MeshLight::turned(f, point)) continue;
    center += (f.a + f.b + f.c) * (f.area / 3);
    area += f.area;
  }
  if (!(area > 0)) return std::nullopt;
  LightView view;
  const Vec3 to_light = center / area - point;
  view.distance = length(to_light);
  if (!(view.distance > 0)) return std::nullopt;
  view.direction = to_light / view.distance;
  view.diameter_over_distance = disk_diameter(area) / view.distance;
  view.own_instance = scene_.lights[index].instance;
  if (mesh.flat) set_plane(view, mesh.faces.front().normal, mesh.faces.front().a, point);
  return view;
}

}  // namespace penumbra
