#include "scene/turntable.h"

#include <cmath>

namespace penumbra {
namespace {

Vec3d turned(const Vec3d& v, double cosine, double sine) {
  return {cosine * v.x + sine * v.z, v.y, cosine * v.z - sine * v.x};
}

}  // namespace

Camera turned_about_scene(const Camera& camera, const Bounds& extent, double angle) {
  const Vec3d eye(camera.position), up(camera.up), aim(camera.look_at);
  const Vec3d view = normalize(aim - eye);
  const double way = dot((Vec3d(extent.lo) + Vec3d(extent.hi)) * 0.5 - eye, view);
  const Vec3d axis = eye + view * std::max(way, 0.0);
  const double cosine = std::cos(angle), sine = std::sin(angle);
  Camera out = camera;
  out.position = Vec3(axis + turned(eye - axis, cosine, sine));
  out.look_at = Vec3(axis + turned(aim - axis, cosine, sine));
  out.up = Vec3(turned(up, cosine, sine));
  return out;
}

}  // namespace penumbra
