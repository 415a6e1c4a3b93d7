#include "render/camera_rays.h"

namespace penumbra {
namespace {

/// right × up looks back at the viewer; any right if `up` is along the view.
Vec3 right_of(const Vec3& forward, const Vec3& up) {
  const Vec3 right = cross(forward, up);
  if (dot(right, right) > 1e-12f * dot(up, up)) return normalize(right);
  return frame_around(forward).u;
}

}  // namespace

CameraRays::CameraRays(const Camera& camera, int width, int height)
    : origin_(camera.position), orthographic_(camera.ortho_height.has_value()) {
  const Vec3 towards = camera.look_at - camera.position;
  forward_ = dot(towards, towards) > 0 ? normalize(towards) : Vec3{0, 0, -1};
  const Vec3 right = right_of(forward_, camera.up);
  const Vec3 up = cross(right, forward_);
  const float tall =
      orthographic_ ? *camera.ortho_height : 2.0f * std::tan(0.5f * camera.vertical_fov);
  pixel_ = tall / static_cast<float>(height);
  step_x_ = right * pixel_;
  step_y_ = up * -pixel_;
  corner_ = step_x_ * (-0.5f * static_cast<float>(width)) +
            step_y_ * (-0.5f * static_cast<float>(height));
}

}  // namespace penumbra
