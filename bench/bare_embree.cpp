#include "bare_embree.h"

#include <algorithm>
#include <stdexcept>

namespace penumbra::bench {
namespace {

RTCRay ray_of(const Vec3& o, const Vec3& d, float t_max) {
  RTCRay r{};
  r.org_x = o.x, r.org_y = o.y, r.org_z = o.z, r.dir_x = d.x, r.dir_y = d.y, r.dir_z = d.z;
  r.tfar = t_max, r.mask = 0xffffffffu;
  return r;
}

void trace_single(RTCScene scene, const std::vector<RTCRay>& rays, std::size_t first,
                  std::size_t last) {
  rtc::Context context;
  rtc::init(context);
  for (std::size_t i = first; i < last; ++i) {
    if (rays[i].tfar < 0) continue;
    RTCRay ray = rays[i];
    rtc::occluded(scene, context, nullptr, ray);
  }
}

template <class Packet, std::size_t width>
void trace_packets(RTCScene scene, const std::vector<RTCRay>& rays, std::size_t first,
                   std::size_t last) {
  rtc::Context context;
  rtc::init(context);
  for (std::size_t i = first; i < last; i += width) {
    Packet p;
    alignas(64) int valid[width];
    for (std::size_t k = 0; k < width; ++k) {
      const RTCRay& r = rays[std::min(i + k, last - 1)];
      valid[k] = i + k < last && r.tfar >= 0 ? -1 : 0;
      p.org_x[k] = r.org_x, p.org_y[k] = r.org_y, p.org_z[k] = r.org_z;
      p.dir_x[k] = r.dir_x, p.dir_y[k] = r.dir_y, p.dir_z[k] = r.dir_z;
      p.tnear[k] = 0, p.tfar[k] = r.tfar, p.mask[k] = r.mask, p.time[k] = 0;
      p.id[k] = 0, p.flags[k] = 0;
    }
    rtc::occluded(valid, scene, context, nullptr, p);
  }
}

template <class T>
T* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
  return static_cast<T*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), count));
}

void attach(RTCScene scene, RTCGeometry geometry) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

}  // namespace

FlatScene::FlatScene(const Scene& scene) : device_(rtcNewDevice(nullptr)) {
  if (!device_) throw std::runtime_error("Embree has no device for this processor");
  scene_ = rtcNewScene(device_);
  attach_triangles(scene);
  attach_spheres(scene);
  rtcCommitScene(scene_);
}

FlatScene::~FlatScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

void FlatScene::attach_triangles(const Scene& scene) {
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* out = new_buffer<Vec3>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                                 mesh.positions.size());
    for (const Vec3& p : mesh.positions) *out++ = instance.world_from_mesh.point(p);
    struct Triangle {
      std::uint32_t v[3];
    };
    auto* indices = new_buffer<Triangle>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                         mesh.triangle_count());
    std::copy(mesh.indices.begin(), mesh.indices.end(), indices->v);
    attach(scene_, geometry);
  }
}

void FlatScene::attach_spheres(const Scene& scene) {
  if (scene.spheres.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  struct Ball {
    float x, y, z, radius;
  };
  auto* out =
      new_buffer<Ball>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, scene.spheres.size());
  for (const Sphere& s : scene.spheres) *out++ = {s.center.x, s.center.y, s.center.z, s.radius};
  attach(scene_, geometry);
}

void trace(RTCScene scene, const std::vector<RTCRay>& rays, std::size_t first, std::size_t last,
           int packet) {
  if (packet == 16) return trace_packets<RTCRay16, 16>(scene, rays, first, last);
  if (packet == 8) return trace_packets<RTCRay8, 8>(scene, rays, first, last);
  trace_single(scene, rays, first, last);
}

std::vector<RTCRay> hard_rays(const Shadows& shadows, const std::vector<Receiver>& points) {
  std::vector<RTCRay> out;
  for (const Receiver& p : points) {
    const auto view = shadows.lights().view(0, p.position);
    if (!view || dot(view->direction, p.normal) <= 0) continue;
    const float epsilon = shadows.world().epsilon_at(p.position);
    out.push_back(ray_of(p.position + p.normal * epsilon, view->direction, view->distance));
  }
  return out;
}

std::vector<RTCRay> area_rays(const Shadows& shadows, const std::vector<Receiver>& points,
                              int count) {
  std::vector<RTCRay> out;
  out.reserve(points.size() * static_cast<std::size_t>(count));
  const World& world = shadows.world();
  const LightSamples samples(count, shadows.options().seed, LightSamples::Order::neighbours);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Receiver& p = points[i];
    const Vec3 origin = p.position + p.normal * world.epsilon_at(p.position);
    const LightPoints light(
        shadows.lights(), 0, p.position,
        on_plane_epsilon(world, shadows.lights().light(0).position, p.position));
    const SamplePattern pattern = samples.pattern(hash(i, 0));
    for (int k = 0; k < count; ++k) {
      const LightTarget t = light.target(pattern, k);
      const bool above = dot(t.direction, p.normal) > 0;
      out.push_back(ray_of(origin, t.direction, above ? std::max(t.t_max, 0.0f) : -1.0f));
    }
  }
  return out;
}

}  // namespace penumbra::bench
