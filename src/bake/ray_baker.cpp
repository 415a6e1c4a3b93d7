#include "bake/ray_baker.h"

#include <algorithm>

#include "bake/barycentric.h"
#include "base/cancel.h"
#include "geometry/embree_scene.h"
#include "shadow/light_points.h"

namespace penumbra::bake {
namespace {

constexpr std::size_t packet = 8;

/// Eight rays from one point, made ready.
class Packet {
 public:
  explicit Packet(const Vec3& origin) {
    for (std::size_t i = 0; i < packet; ++i) {
      rays_.org_x[i] = origin.x, rays_.org_y[i] = origin.y, rays_.org_z[i] = origin.z;
      rays_.tnear[i] = rays_.time[i] = 0;
      rays_.mask[i] = 0xffffffffu, rays_.id[i] = 0, rays_.flags[i] = 0;
    }
  }
  void clear() { std::fill_n(valid_, packet, 0); }
  void aim(std::size_t i, const Vec3& direction, float t_max) {
    rays_.dir_x[i] = direction.x, rays_.dir_y[i] = direction.y, rays_.dir_z[i] = direction.z;
    rays_.tfar[i] = std::max(t_max, 0.0f);
    valid_[i] = -1;
  }
  void trace(const World& world, int excluded) { world.occluded(valid_, rays_, excluded); }
  bool arrived(std::size_t i) const { return valid_[i] == -1 && rays_.tfar[i] >= 0; }

 private:
  alignas(32) RTCRay8 rays_;
  alignas(32) int valid_[packet];
};

}  // namespace

/// Calls visit(number, arrived) for the light's samples in order.
template <class Visit>
void RayBaker::trace(const Receiver& receiver, const SampledLight& light,
                     const Visit& visit) const {
  const Vec3 &p = receiver.position, &n = receiver.normal;
  Packet rays(p + n * world_.epsilon_at(p));
  for (std::size_t first = 0; first < light.samples.size(); first += packet) {
    if (first % 1024 == 0) throw_if_cancelled();
    const std::size_t count = std::min(packet, light.samples.size() - first);
    rays.clear();
    bool any = false;
    for (std::size_t i = 0; i < count; ++i) {
      const LightSample& s = light.samples[first + i];
      const bool far = light.kind == EmitterKind::direction;
      const Vec3 to = far ? s.position : s.position - p;
      const float distance = far ? INFINITY : length(to);
      if (!(dot(to, n) > 0) || !(distance > 0)) continue;
      float t_max = distance;
      if (light.flat) {
        // What is on the light's own plane does not occlude: stop short of it, measured across it.
        const float lean = std::max(std::abs(dot(to, s.normal)) / distance, 1e-4f);
        t_max -= on_plane_epsilon(world_, s.position, p) / lean;
      }
      rays.aim(i, far ? to : to / distance, t_max), any = true;
    }
    if (any) rays.trace(world_, light.own_instance);
    for (std::size_t i = 0; i < count; ++i) visit(first + i, rays.arrived(i));
  }
}

PointLight RayBaker::light(const Receiver& receiver, const SampledLight& light) const {
  const Vec3 &p = receiver.position, &n = receiver.normal;
  float whole_share = 0, whole_irradiance = 0;
  PointLight sum;
  trace(receiver, light, [&](std::size_t i, bool arrived) {
    const float share = share_of(light, light.samples[i], p);
    const float irradiance = irradiance_of(light, light.samples[i], p, n);
    whole_share += share, whole_irradiance += irradiance;
    if (!arrived) return;
    sum.fraction += share, sum.irradiance += irradiance;
  });
  if (whole_irradiance > 0) sum.lit_part = std::min(sum.irradiance / whole_irradiance, 1.0f);
  if (light.is_ratio() && whole_irradiance > 0)
    sum.irradiance *= whole_irradiance_of(light, p, n) / whole_irradiance;
  sum.irradiance *= light.spot_part(p);
  sum.fraction = whole_share > 0 ? std::min(sum.fraction / whole_share, 1.0f) : 0;
  return sum;
}

void RayBaker::visible_samples(const Receiver& receiver, const SampledLight& light,
                               std::span<std::uint8_t> out) const {
  trace(receiver, light, [&](std::size_t i, bool arrived) { out[i] = arrived ? 1 : 0; });
}

Receiver RayBaker::receiver(const SurfacePoint& point) const {
  const Receiver flat{point.position, point.normal};
  const Scene& scene = world_.scene();
  if (point.instance >= scene.instances.size()) return flat;
  const Instance& instance = scene.instances[point.instance];
  const Mesh& mesh = scene.meshes[instance.mesh];
  if (mesh.normals.empty()) return flat;
  const auto corner = [&](std::size_t i) {
    const std::uint32_t v = mesh.indices[std::size_t{3} * point.triangle + i];
    return instance.world_from_mesh.point(Vec3d(mesh.positions[v]));
  };
  const Vec2 b = barycentric(corner(0), corner(1), corner(2), Vec3d(point.position));
  const Ray ray{point.position + point.normal, -point.normal};
  const Hit hit{1, b.x, b.y, {point.instance, point.triangle}};
  return receiver_of(world_.surface(ray, hit));
}

}  // namespace penumbra::bake
