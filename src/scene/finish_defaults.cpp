#include <fmt/core.h>

#include <numbers>

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

/// The least distance from the box's centre at which a camera sees all of its corners.
double framing_distance(const Bounds& box, const View& view) {
  const double tan_y = std::tan(kVerticalFov / 2) / kMargin, tan_x = tan_y * kAspect;
  const Vec3d half = Vec3d(box.hi) * 0.5 - Vec3d(box.lo) * 0.5;
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p(corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y,
                  corner & 4 ? half.z : -half.z);
    const double needed =
        std::max(std::abs(dot(p, view.right)) / tan_x, std::abs(dot(p, view.up)) / tan_y);
    distance = std::max(distance, dot(p, view.back) + needed);
  }
  return distance;
}

Camera framing_camera(const Bounds& box) {
  const View view = view_along(normalize(Vec3d{0.55, 0.4, 1}), {0, 1, 0});
  Camera camera;
  camera.name = "framing";
  camera.look_at = box.center();
  camera.position = Vec3(Vec3d(box.center()) + view.back * framing_distance(box, view));
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

/// For a model on its own: above and to the left of the camera's direction.
Light light_for_model(const Bounds& box, const Camera& camera) {
  const Vec3d center(box.center());
  const View view = view_along(direction_or_z(Vec3d(camera.position) - center), Vec3d(camera.up));
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

}  // namespace

void add_missing_camera_and_light(Scene& scene) {
  const bool needs_camera = scene.cameras.empty(), needs_light = scene.lights.empty();
  if (!needs_camera && !needs_light) return;
  const Bounds box = bounds_of(scene);
  if (box.empty()) return;
  auto& notes = scene.report.conversions;
  if (needs_camera) {
    scene.cameras.push_back(framing_camera(box));
    notes.push_back("the file has no camera: added one that frames the scene");
  }
  if (needs_light) {
    scene.lights.push_back(needs_camera ? light_for_model(box, scene.cameras.front())
                                        : light_beside_camera(box, scene.cameras.front()));
    notes.push_back("the file has no light: added a soft key light near the camera's side");
  }
}

}  // namespace penumbra
