#include "bake/light_sampler.h"

#include <algorithm>
#include <numbers>

#include "bake/sample_grid.h"
#include "render/cone_irradiance.h"
#include "shadow/light_samples.h"

namespace penumbra::bake {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr int fewest = 16, most = 4096;

Vec3 center_of(const ReceiverPatch& r) {
  return (r.corners[0] + r.corners[1] + r.corners[2] + r.corners[3]) * 0.25f;
}

/// The point of the receiver's parallelogram nearest to p, or one not far from it: exact for
/// rectangles.
Vec3 nearest_point(const ReceiverPatch& r, const Vec3& p) {
  const Vec3 u = r.corners[1] - r.corners[0], v = r.corners[3] - r.corners[0];
  const auto along = [](const Vec3& to, const Vec3& edge) {
    const float d2 = dot(edge, edge);
    return d2 > 0 ? std::clamp(dot(to, edge) / d2, 0.0f, 1.0f) : 0.0f;
  };
  const float a = along(p - r.corners[0], u);
  const float b = along(p - r.corners[0] - u * a, v);
  return r.corners[0] + u * along(p - r.corners[0] - v * b, u) + v * b;
}

bool is_extended(const Light& light) { return !is_point(light); }

float area_of(const Light& light, const MeshLight& mesh) {
  switch (light.type) {
    case LightType::sphere:
    case LightType::disk:
      return pi * light.radius * light.radius;
    case LightType::rect:
      return length(cross(light.edge_u, light.edge_v));
    case LightType::segment:
      return 2 * light.radius * length(light.edge_u);
    default:
      return mesh.areas.empty() ? 0 : mesh.areas.back();
  }
}

void add_plane(const Light& light, const std::vector<Vec2>& grid, float area, SampledLight& out) {
  out.flat = true;
  const float share = area / static_cast<float>(grid.size());
  const bool disk = light.type == LightType::disk;
  const Frame frame = frame_around(light.normal);
  for (const Vec2& square : grid) {
    const Vec2 on_disk = concentric(square);
    const Vec3 off = disk ? (frame.u * on_disk.x + frame.v * on_disk.y) * light.radius
                          : light.edge_u * (square.x - 0.5f) + light.edge_v * (square.y - 0.5f);
    out.samples.push_back({light.position + off, light.normal, share});
  }
}

void add_segment(const Light& light, const std::vector<Vec2>& grid, float area, SampledLight& out) {
  out.kind = EmitterKind::strip;
  const Vec3 along = normalize(light.edge_u);
  for (const Vec2& p : grid)
    out.samples.push_back({light.position + light.edge_u * (p.x - 0.5f), along,
                           area / static_cast<float>(grid.size())});
}

void add_sun(const Light& light, const std::vector<Vec2>& grid, SampledLight& out) {
  out.kind = EmitterKind::direction;
  const Frame frame = frame_around(-light.direction);
  const float s = std::sin(light.angular_diameter / 4), one_minus_cosine = 2 * s * s;
  // Its irradiance on a surface that faces its centre is the projected solid angle times its
  // radiance: π sin² α, where the solid angle is 2π (1 − cos α).
  const float per_radiance = 2 / (2 - one_minus_cosine);
  for (const Vec2& square : grid) {
    const Vec2 p = concentric(square);
    const float away = (p.x * p.x + p.y * p.y) * one_minus_cosine;
    const float k = std::sqrt(one_minus_cosine * (2 - away));
    out.samples.push_back({frame.u * (k * p.x) + frame.v * (k * p.y) + frame.w * (1 - away),
                           light.direction, per_radiance / static_cast<float>(grid.size())});
  }
}

bool lights_any_corner(const SampledLight& light, const LightSample& s, const ReceiverPatch& r) {
  if (light.kind != EmitterKind::surface || light.two_sided) return true;
  return std::ranges::any_of(r.corners,
                             [&](const Vec3& c) { return dot(s.normal, c - s.position) > 0; });
}

bool is_in_front(const SampledLight& light, const LightSample& s, const ReceiverPatch& r) {
  const Vec3 to = light.kind == EmitterKind::direction ? s.position : s.position - r.corners[0];
  return dot(to, r.normal) > 0;
}

}  // namespace

float SampledLight::spot_part(const Vec3& p) const {
  if (!is_spot) return 1;
  const Vec3 to = position - p;
  const float d = length(to);
  if (!(d > 0)) return 1;
  const float x =
      (-dot(spot_axis, to) / d - spot_cos_outer) / std::max(1e-4f, spot_cos_inner - spot_cos_outer);
  const float s = std::clamp(x, 0.0f, 1.0f);
  return s * s * (3 - 2 * s);
}

float LightSampler::solid_angle(std::size_t index, const ReceiverPatch& receiver) const {
  const Light& light = lights_.light(index);
  if (light.type == LightType::sun) return 2 * pi * (1 - std::cos(light.angular_diameter / 2));
  const MeshLight& mesh = lights_.mesh_light(index);
  const Vec3 center = light.type == LightType::mesh ? mesh.center : light.position;
  const Vec3 to = nearest_point(receiver, center) - center;
  const float area = area_of(light, mesh);
  // As a disk: never more than a half space.
  return 2 * pi * area / (pi * dot(to, to) * 2 + area);
}

int LightSampler::count(std::size_t index, const ReceiverPatch& receiver) const {
  const Light& light = lights_.light(index);
  if (!is_extended(light)) return 1;
  const float scale = options_.samples_scale * receiver.samples_scale;
  if (options_.light_samples > 0)
    return std::max(
        1, static_cast<int>(std::lround(static_cast<float>(options_.light_samples) * scale)));
  const float n = solid_angle(index, receiver) / options_.solid_angle;
  const float wanted = std::clamp(n, float{fewest}, float{most}) * scale;
  return static_cast<int>(std::ceil(std::clamp(wanted, 1.0f, float{most})));
}

std::vector<Vec2> LightSampler::grid(std::size_t light, std::uint32_t set, int count,
                                     float aspect) const {
  // The same for all receivers, so that neighbours that share a plane show no seam.
  return sample_grid(count, aspect, options_.placement,
                     hash(options_.seed, lights_.pattern_of(light)) + 0x9e3779b97f4a7c15u * set);
}

// Density on the sphere ∝ cos φ + b, φ from the axis towards the receiver, as far as c, the cosine
// of the furthest φ that any point of the receiver sees: uniform on the disk that a far receiver
// sees, and more even round the sphere for a receiver that sees more of it than half.
void LightSampler::add_sphere(const Light& light, const ReceiverPatch& receiver,
                              const std::vector<Vec2>& grid, SampledLight& out) const {
  out.measure = FractionMeasure::solid_angle;
  const Vec3 to = center_of(receiver) - light.position;
  const float distance = length(to);
  const Vec3 axis = distance > 0 ? to / distance : receiver.normal;
  float furthest = 0, cosine = 1;
  for (const Vec3& corner : receiver.corners) {
    const Vec3 way = corner - light.position;
    const float d = length(way);
    furthest = std::max(furthest, d);
    cosine = std::min(cosine, d > 0 ? dot(way, axis) / d : -1.0f);
  }
  out.two_sided = furthest < light.radius;
  float c = -1;
  if (cosine > 0 && light.radius < furthest) {
    const float angle = std::acos(light.radius / furthest) + std::acos(std::min(cosine, 1.0f));
    if (angle < pi) c = std::cos(angle);
  }
  const Frame frame = frame_around(axis);
  const float b = c < 0 ? -2 * c : -c, top = 1 + b, rim = c + b, all = top * top - rim * rim;
  const float area = pi * light.radius * light.radius / static_cast<float>(grid.size());
  for (const Vec2& square : grid) {
    const Vec2 p = concentric(square);
    const float u = std::min(p.x * p.x + p.y * p.y, 1.0f);
    const float density = std::sqrt(top * top - u * all);
    const float z = std::clamp(density - b, -1.0f, 1.0f);
    const float k = u > 0 ? std::sqrt(std::max(0.0f, (1 - z) * (1 + z)) / u) : 0;
    const Vec3 normal = frame.u * (k * p.x) + frame.v * (k * p.y) + frame.w * z;
    out.samples.push_back(
        {light.position + normal * light.radius, normal, area * all / std::max(density, 1e-3f)});
  }
}

void LightSampler::add_mesh(std::size_t index, const ReceiverPatch& receiver, int count,
                            SampledLight& out) const {
  const MeshLight& mesh = lights_.mesh_light(index);
  const Light& light = lights_.light(index);
  out.measure = mesh.flat ? FractionMeasure::count : FractionMeasure::turned;
  out.flat = mesh.flat;
  out.two_sided = light.double_sided && !mesh.closed;
  out.own_instance = light.instance;
  if (mesh.faces.empty()) return;
  std::vector<std::uint32_t> faces;  // empty: all
  std::vector<float> some;
  if (!out.two_sided && !mesh.flat) {
    for (std::uint32_t i = 0; i < mesh.faces.size(); ++i) {
      const LightFace& f = mesh.faces[i];
      if (std::ranges::none_of(receiver.corners,
                               [&](const Vec3& c) { return MeshLight::turned(f, c); }))
        continue;
      faces.push_back(i);
      some.push_back((some.empty() ? 0 : some.back()) + f.area);
    }
    // Its visible fraction is defined everywhere, as of all faces.
    if (faces.empty()) out.measure = FractionMeasure::count;
  }
  const std::vector<float>& areas = faces.empty() ? mesh.areas : some;
  const float share = areas.back() / static_cast<float>(count);
  const float aspect = static_cast<float>(areas.size()) / 2;
  for (const Vec2& p : grid(index, receiver.set, count, aspect)) {
    const float before = p.x * areas.back();
    const auto at = std::upper_bound(areas.begin(), areas.end() - 1, before);
    const auto i = static_cast<std::size_t>(at - areas.begin());
    const LightFace& f = mesh.faces[faces.empty() ? i : faces[i]];
    const float left = i > 0 ? before - areas[i - 1] : before;
    const float root = std::sqrt(std::clamp(left / f.area, 0.0f, 1.0f));
    out.samples.push_back(
        {f.a * (1 - root) + f.b * (root * (1 - p.y)) + f.c * (root * p.y), f.normal, share});
  }
}

SampledLight LightSampler::sample(std::size_t index, const ReceiverPatch& receiver,
                                  bool all) const {
  const Light& light = lights_.light(index);
  SampledLight out;
  out.emission = light.emission;
  const int n = count(index, receiver);
  const float area = area_of(light, lights_.mesh_light(index));
  out.position = light.position;
  if (light.type == LightType::sphere) out.radius = light.radius;
  if (light.type == LightType::point || light.type == LightType::sphere) {
    out.is_spot = light.spot_cos_outer > -1;
    out.spot_axis = light.normal;
    out.spot_cos_inner = light.spot_cos_inner, out.spot_cos_outer = light.spot_cos_outer;
  }
  if (light.type == LightType::sun) {
    add_sun(light, grid(index, receiver.set, n, 1), out);
  } else if (light.type == LightType::mesh) {
    add_mesh(index, receiver, n, out);
  } else if (is_point(light)) {
    out.kind = EmitterKind::point;
    out.samples.push_back({light.position, light.normal, 1});
  } else if (light.type == LightType::sphere) {
    add_sphere(light, receiver, grid(index, receiver.set, n, 1), out);
  } else if (light.type == LightType::segment) {
    if (area > 0)
      add_segment(light, grid(index, receiver.set, n, static_cast<float>(n)), area, out);
  } else if (area > 0) {
    const bool rect = light.type == LightType::rect;
    const float aspect = rect ? length(light.edge_u) / length(light.edge_v) : 1;
    add_plane(light, grid(index, receiver.set, n, aspect), area, out);
  }
  if (!all)
    std::erase_if(out.samples, [&](const LightSample& s) {
      return !is_in_front(out, s, receiver) || !lights_any_corner(out, s, receiver);
    });
  return out;
}

float irradiance_of(const SampledLight& light, const LightSample& s, const Vec3& p, const Vec3& n) {
  if (light.kind == EmitterKind::direction) return s.weight * std::max(0.0f, dot(s.position, n));
  const Vec3 to = s.position - p;
  const float d2 = std::max(dot(to, to), 1e-12f), up = dot(to, n);
  if (!(up > 0)) return 0;
  const float along = -dot(to, s.normal);
  switch (light.kind) {
    case EmitterKind::point:
      return up / (d2 * std::sqrt(d2));
    case EmitterKind::strip:
      return s.weight * up * std::sqrt(std::max(0.0f, d2 - along * along)) /
             (d2 * (d2 + s.weight / pi));
    default:
      return s.weight * up * (light.two_sided ? std::abs(along) : std::max(0.0f, along)) /
             (d2 * (d2 + s.weight / pi));
  }
}

float whole_irradiance_of(const SampledLight& light, const Vec3& p, const Vec3& n) {
  return sphere_irradiance(light.position - p, light.radius, n, Horizon::exact);
}

float share_of(const SampledLight& light, const LightSample& s, const Vec3& p) {
  if (light.measure == FractionMeasure::count) return 1;
  const Vec3 to = s.position - p;
  const float along = -dot(to, s.normal), facing = light.two_sided ? std::abs(along) : along;
  if (light.measure == FractionMeasure::turned) return facing > 0 ? 1 : 0;
  const float d2 = std::max(dot(to, to), 1e-12f);
  return s.weight * std::max(0.0f, facing) / (d2 * std::sqrt(d2));
}

}  // namespace penumbra::bake
