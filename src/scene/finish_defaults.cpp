#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "scene/extent.h"
#include "scene/finish.h"

namespace penumbra {
namespace {

constexpr double kVerticalFov = 40 * std::numbers::pi / 180;
constexpr double kAspect = 16.0 / 9.0;
constexpr double kMargin = 1.06;  ///< of the picture's half size, so that nothing touches its edge

/// The unit vector along v; the z axis if v has no direction.
Vec3d direction_or_z(const Vec3d& v) { return length(v) > 0 ? normalize(v) : Vec3d{0, 0, 1}; }

/// A camera's axes: right, up and back (towards the viewer), unit vectors.
struct View {
  Vec3d right, up, back;
};

View view_along(const Vec3d& back, Vec3d up) {
  if (length(cross(up, back)) <= 1e-6 * length(up))  // looks along its up vector
    up = std::abs(back.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
  const Vec3d right = normalize(cross(up, back));
  return {right, cross(back, right), back};
}

View framing_view() { return view_along(normalize(Vec3d{0.55, 0.4, 1}), {0, 1, 0}); }

/// How far the scene reaches along each of four directions: the greatest dot product.
using Reach = std::array<double, 4>;

Reach reach_of(const Scene& scene, const std::array<Vec3d, 4>& along) {
  Reach reach;
  reach.fill(-INFINITY);
  const auto grow = [&](const Vec3d& p, double radius) {
    for (std::size_t i = 0; i < 4; ++i)
      reach[i] = std::max(reach[i], dot(p, along[i]) + radius * length(along[i]));
  };
  for (const Instance& instance : scene.instances)
    for (const Vec3& p : scene.meshes[instance.mesh].positions)
      grow(instance.world_from_mesh.point(Vec3d(p)), 0);
  for (const Sphere& sphere : scene.spheres) grow(Vec3d(sphere.center), sphere.radius);
  for (const SdfTree& tree : scene.sdfs) {
    const Bounds box = bounds_of_finite_parts(tree);
    if (box.empty()) continue;
    for (int i = 0; i < 8; ++i)
      grow(Vec3d(i & 1 ? box.hi.x : box.lo.x, i & 2 ? box.hi.y : box.lo.y,
                 i & 4 ? box.hi.z : box.lo.z),
           0);
  }
  return reach;
}

/// The nearest camera that sees every vertex and sphere, with as much room on the left as on the
/// right and above as below. In the view's coordinates, z backwards, the camera c sees p if
/// |p.x − c.x| ≤ (c.z − p.z) tan_x: both signs bound c.x and c.z by the reach of the scene along
/// ±x + z tan_x; the same for y.
Camera framing_camera(const Scene& scene, const Bounds& box) {
  const View view = framing_view();
  const double tan_y = std::tan(kVerticalFov / 2) / kMargin, tan_x = tan_y * kAspect;
  const Vec3d back_x = view.back * tan_x, back_y = view.back * tan_y;
  const Reach reach = reach_of(
      scene, {view.right + back_x, -view.right + back_x, view.up + back_y, -view.up + back_y});
  const double x = (reach[0] - reach[1]) / 2, y = (reach[2] - reach[3]) / 2;
  const double z =
      std::max((reach[0] + reach[1]) / (2 * tan_x), (reach[2] + reach[3]) / (2 * tan_y));
  const Vec3d axis = view.right * x + view.up * y;
  Camera camera;
  camera.name = "framing";
  camera.position = Vec3(axis + view.back * z);
  camera.look_at = Vec3(axis + view.back * dot(Vec3d(box.center()), view.back));
  camera.vertical_fov = static_cast<float>(kVerticalFov);
  return camera;
}

/// A sphere light that gives a surface at `target` facing it an irradiance of π: a white one then
/// has radiance 1. From E = π L (r/d)², the irradiance of a sphere of radius r at distance d.
Light key_light(const Vec3d& position, const Vec3d& target, double radius) {
  const double ratio = length(position - target) / radius;
  Light light;
  light.type = LightType::sphere;
  light.name = "key";
  light.position = Vec3(position);
  light.radius = static_cast<float>(radius);
  light.emission = Vec3(static_cast<float>(ratio * ratio));
  return light;
}

/// For a model on its own: above and to the left of the framing camera's direction.
Light light_for_model(const Bounds& box) {
  const Vec3d center(box.center());
  const View view = framing_view();
  const Vec3d direction = normalize(view.back - view.right * 0.7 + view.up * 0.9);
  const double distance = 2.5 * 0.5 * box.diagonal();
  return key_light(center + direction * distance, center, 0.15 * distance);
}

/// For a scene that its author chose a view of: beside that camera, where the way into the scene is
/// known to be open.
Light light_beside_camera(const Bounds& box, const Camera& camera) {
  const Vec3d eye(camera.position), center(box.center());
  const Vec3d back = direction_or_z(eye - Vec3d(camera.look_at));
  const View view = view_along(back, Vec3d(camera.up));
  const double distance = std::max(length(eye - center), 0.25 * box.diagonal());
  const Vec3d position = eye + (view.up - view.right) * (0.15 * distance);
  return key_light(position, eye - back * distance, 0.1 * distance);
}

void add_defaults_without_end(Scene& scene) {
  if (is_bounded(scene)) return;  // there is nothing to look at
  auto& notes = scene.report.conversions;
  if (scene.cameras.empty()) {
    scene.cameras.push_back(default_view());
    notes.emplace_back(
        "the file has no camera, and nothing in it has an end: added a view from (3.2, 2.6, 4.4) "
        "to (0, 0.4, 0)");
  }
  if (scene.lights.empty()) {
    scene.lights.push_back(default_sun());
    notes.emplace_back("the file has no light: added a sun of 6 degrees");
  }
}

/// No light would change what is seen of it.
bool is_unlit(const Scene& scene) {
  return !scene.instances.empty() && scene.spheres.empty() && scene.sdfs.empty() &&
         std::ranges::all_of(scene.instances, [&](const Instance& instance) {
           return scene.materials[instance.material].unlit > 0;
         });
}

}  // namespace

Camera default_view() {
  Camera camera;
  camera.name = "default";
  camera.position = {3.2f, 2.6f, 4.4f};
  camera.look_at = {0, 0.4f, 0};
  camera.vertical_fov = static_cast<float>(kVerticalFov);
  return camera;
}

Light default_sun() {
  Light sun;
  sun.type = LightType::sun;
  sun.name = "sun";
  sun.direction = Vec3(normalize(Vec3d(-0.5, -0.8, -0.3)));
  sun.angular_diameter = static_cast<float>(6 * std::numbers::pi / 180);
  sun.emission = Vec3(std::numbers::pi_v<float>);
  return sun;
}

void add_missing_camera_and_light(Scene& scene) {
  const bool needs_camera = scene.cameras.empty();
  const bool needs_light = scene.lights.empty() && !is_unlit(scene);
  if (!needs_camera && !needs_light) return;
  const Bounds box = bounds_of(scene);
  if (box.empty()) return add_defaults_without_end(scene);
  auto& notes = scene.report.conversions;
  if (needs_camera) {
    scene.cameras.push_back(framing_camera(scene, box));
    notes.push_back(std::string("the file has no camera: added one that frames the scene") +
                    (is_bounded(scene) ? "" : "'s finite parts, for some of it has no end"));
  }
  if (needs_light) {
    scene.lights.push_back(needs_camera ? light_for_model(box)
                                        : light_beside_camera(box, scene.cameras.front()));
    notes.push_back("the file has no light: added a soft key light near the camera's side");
  }
}

}  // namespace penumbra
