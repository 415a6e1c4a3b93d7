#include "shadow/light_points.h"

#include <algorithm>
#include <numbers>

namespace penumbra {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

using Kind = LightPoints::Shape::Kind;

}  // namespace

LightPoints::LightPoints(const LightViews& lights, std::size_t index, const Vec3& point,
                         float epsilon)
    : point_(point) {
  const Light& light = lights.light(index);
  shape_.center = light.position - point;
  shape_.epsilon = epsilon;
  shape_.normal = light.normal;
  shape_.u = light.edge_u, shape_.v = light.edge_v;
  shape_.radius = light.radius;
  switch (light.type) {
    case LightType::sphere:
    case LightType::sun:
      set_cone(light);
      return;
    case LightType::disk: {
      const Frame frame = frame_around(light.normal);
      shape_.kind = Kind::plane, takes_disk_ = true;
      shape_.u = frame.u * light.radius, shape_.v = frame.v * light.radius;
      shape_.area = pi * light.radius * light.radius;
      return;
    }
    case LightType::rect:
      shape_.kind = Kind::plane;
      // The square is [0, 1)², its middle the light's.
      shape_.center = shape_.center - (light.edge_u + light.edge_v) * 0.5f;
      shape_.area = length(cross(light.edge_u, light.edge_v));
      return;
    case LightType::segment:
      shape_.kind = Kind::line;
      shape_.center = shape_.center - light.edge_u * 0.5f;
      return;
    case LightType::mesh:
      set_faces(lights.mesh_light(index), light.double_sided);
      return;
    case LightType::point:
      return;
  }
}

void LightPoints::set_cone(const Light& light) {
  shape_.kind = Kind::cone, takes_disk_ = true;
  Vec3 axis = -light.direction;
  if (light.type == LightType::sun) {
    const float s = std::sin(light.angular_diameter / 4);
    shape_.one_minus_cosine = 2 * s * s;
    shape_.solid_angle = 1;
  } else {
    shape_.distance = length(shape_.center);
    axis = shape_.distance > 0 ? shape_.center / shape_.distance : Vec3{0, 1, 0};
    const float sine = light.radius / std::max(shape_.distance, 1e-30f);
    // From inside, the sphere fills all directions.
    shape_.one_minus_cosine = sine >= 1 ? 2 : sine * sine / (1 + std::sqrt(1 - sine * sine));
    shape_.solid_angle = 2 * pi * shape_.one_minus_cosine;
  }
  const Frame frame = frame_around(axis);
  shape_.u = frame.u, shape_.v = frame.v, shape_.w = frame.w;
}

void LightPoints::set_faces(const MeshLight& mesh, bool double_sided) {
  shape_.kind = Kind::faces;
  shape_.two_sided = double_sided;
  mesh_ = &mesh;
  shape_.area = mesh.seen_from(point_, double_sided, &runs_).area;
}

LightPoints::OnFace LightPoints::on_face(float x, float y) const {
  if (runs_.empty()) return {};
  // The run, and the place among all areas that stands for this one among the runs'.
  float before = x * shape_.area;
  const auto run =
      std::upper_bound(runs_.begin(), runs_.end() - 1, before,
                       [](float area, const MeshLight::Run& r) { return area < r.area; });
  if (run != runs_.begin()) before -= std::prev(run)->area;
  const std::vector<float>& areas = mesh_->areas;
  if (run->first > 0) before += areas[run->first - 1];
  const auto at =
      std::upper_bound(areas.begin() + run->first, areas.begin() + run->last - 1, before);
  const auto i = static_cast<std::size_t>(at - areas.begin());
  const LightFace& face = mesh_->faces[i];
  const float left = i > 0 ? before - areas[i - 1] : before;
  const float root = std::sqrt(std::clamp(left / face.area, 0.0f, 1.0f));
  return {face.a * (1 - root) + face.b * (root * (1 - y)) + face.c * (root * y) - point_,
          face.normal};
}

LightTarget LightPoints::target(const SamplePattern& pattern, int i) const {
  const float* x = takes_disk_ ? pattern.disk_x : pattern.square_x;
  const float* y = takes_disk_ ? pattern.disk_y : pattern.square_y;
  alignas(32) float xs[LightPacket::size], ys[LightPacket::size];
  std::fill_n(xs, LightPacket::size, x[i]), std::fill_n(ys, LightPacket::size, y[i]);
  LightPacket p;
  packet(pattern, xs, ys, p);
  return {{p.x[0], p.y[0], p.z[0]}, p.t_max[0], p.weight[0]};
}

}  // namespace penumbra
