#include "shadow/light_points.h"

#include <algorithm>
#include <numbers>

namespace penumbra {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

}  // namespace

LightPoints::LightPoints(const LightViews& lights, std::size_t index, const Vec3& point,
                         float epsilon)
    : light_(lights.light(index)),
      mesh_(lights.mesh_light(index)),
      point_(point),
      epsilon_(epsilon) {
  switch (light_.type) {
    case LightType::sphere: {
      const Vec3 to_center = light_.position - point;
      distance_ = length(to_center);
      frame_ = frame_around(distance_ > 0 ? to_center / distance_ : Vec3{0, 1, 0});
      const float sine = light_.radius / std::max(distance_, 1e-30f);
      // From inside, the sphere fills all directions.
      one_minus_cosine_ = sine >= 1 ? 2 : sine * sine / (1 + std::sqrt(1 - sine * sine));
      break;
    }
    case LightType::sun: {
      frame_ = frame_around(-light_.direction);
      const float s = std::sin(light_.angular_diameter / 4);
      one_minus_cosine_ = 2 * s * s;
      break;
    }
    case LightType::disk:
      frame_ = frame_around(light_.normal);
      area_ = pi * light_.radius * light_.radius;
      break;
    case LightType::rect:
      area_ = length(cross(light_.edge_u, light_.edge_v));
      break;
    case LightType::mesh:
      all_faces_ = mesh_.takes_all(point, light_.double_sided);
      for (const LightFace& f : mesh_.faces)
        if (all_faces_ || MeshLight::turned(f, point)) area_ += f.area;
      break;
    default:
      break;
  }
}

LightTarget LightPoints::on_cone(Vec2 disk) const {
  const float u = disk.x * disk.x + disk.y * disk.y;
  const float z = 1 - u * one_minus_cosine_;
  // (1 − z²) / u, without the difference that a small light would lose.
  const float across = std::sqrt(std::max(0.0f, one_minus_cosine_ * (1 + z)));
  const Vec3 d = frame_.u * (disk.x * across) + frame_.v * (disk.y * across) + frame_.w * z;
  if (light_.type == LightType::sun) return {d, INFINITY, 1};
  // Where the ray enters the sphere, or leaves it if it began inside.
  const float r = light_.radius, sine2 = u * one_minus_cosine_ * (1 + z);
  const float half = std::sqrt(std::max(0.0f, r * r - distance_ * distance_ * sine2));
  const float t = distance_ > r ? distance_ * z - half : distance_ * z + half;
  return {d, t, 2 * pi * one_minus_cosine_};
}

LightTarget LightPoints::on_surface(const Vec3& p, const Vec3& normal, float area,
                                    bool both_sides) const {
  const Vec3 to = p - point_;
  const float d2 = dot(to, to), inv = 1 / std::sqrt(std::max(d2, 1e-30f));
  const Vec3 direction = to * inv;
  const float cosine = -dot(direction, normal);
  const float facing = both_sides ? std::abs(cosine) : std::max(cosine, 0.0f);
  // Stop short of the light's own plane by epsilon, measured across it.
  const float stop = d2 * inv - epsilon_ / std::max(std::abs(cosine), 1e-4f);
  return {direction, stop, area * facing * inv * inv};
}

LightTarget LightPoints::on_mesh(Vec2 square) const {
  float left = square.x * area_;
  const LightFace* face = nullptr;
  for (const LightFace& f : mesh_.faces) {
    if (!all_faces_ && !MeshLight::turned(f, point_)) continue;
    face = &f;
    if (left < f.area) break;
    left -= f.area;
  }
  if (!face) return {};
  const float u = std::clamp(left / face->area, 0.0f, 1.0f), root = std::sqrt(u);
  const Vec3 p =
      face->a * (1 - root) + face->b * (root * (1 - square.y)) + face->c * (root * square.y);
  return on_surface(p, face->normal, area_, light_.double_sided);
}

LightTarget LightPoints::target(const SamplePattern& pattern, int i) const {
  switch (light_.type) {
    case LightType::sphere:
    case LightType::sun:
      return on_cone(pattern.disk_point(i));
    case LightType::disk: {
      const Vec2 q = pattern.disk_point(i);
      const Vec3 p = light_.position + (frame_.u * q.x + frame_.v * q.y) * light_.radius;
      return on_surface(p, light_.normal, area_, false);
    }
    case LightType::rect: {
      const Vec2 q = pattern.square_point(i);
      const Vec3 p = light_.position + light_.edge_u * (q.x - 0.5f) + light_.edge_v * (q.y - 0.5f);
      return on_surface(p, light_.normal, area_, false);
    }
    case LightType::mesh:
      return on_mesh(pattern.square_point(i));
    case LightType::segment: {
      const Vec3 p = light_.position + light_.edge_u * (pattern.square_point(i).x - 0.5f);
      const Vec3 to = p - point_;
      const float d = std::max(length(to), 1e-30f);
      const float apparent = 2 * light_.radius * length(cross(light_.edge_u, to / d));
      return {to / d, d, apparent / (d * d)};
    }
    case LightType::point:
      break;
  }
  const Vec3 to = light_.position - point_;
  const float d = std::max(length(to), 1e-30f);
  return {to / d, d, 1 / (d * d)};
}

}  // namespace penumbra
