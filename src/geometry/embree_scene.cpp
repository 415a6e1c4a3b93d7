#include "geometry/embree_scene.h"

#include <array>
#include <string>

#include "base/error.h"

namespace penumbra {
namespace {

// Embree 3 and 4 give a filter the same arguments; the hit of a masked surface is refused where the
// texture has a hole.
void pass_holes(const RTCFilterFunctionNArguments* args) {
  const auto& masked = *static_cast<const MaskedMesh*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const unsigned triangle = RTCHitN_primID(args->hit, args->N, i);
    const float b1 = RTCHitN_u(args->hit, args->N, i), b2 = RTCHitN_v(args->hit, args->N, i);
    if (masked.distance(triangle, b1, b2) > 0) args->valid[i] = 0;
  }
}

// Winding and direction are both in the mesh's frame here.
bool from_behind(const RTCFilterFunctionNArguments* args, unsigned i) {
  return RTCHitN_Ng_x(args->hit, args->N, i) * RTCRayN_dir_x(args->ray, args->N, i) +
             RTCHitN_Ng_y(args->hit, args->N, i) * RTCRayN_dir_y(args->ray, args->N, i) +
             RTCHitN_Ng_z(args->hit, args->N, i) * RTCRayN_dir_z(args->ray, args->N, i) >
         0;
}

void pass_backs_and_holes(const RTCFilterFunctionNArguments* args) {
  if (static_cast<const MaskedMesh*>(args->geometryUserPtr)->culls_back)
    for (unsigned i = 0; i < args->N; ++i)
      if (args->valid[i] == -1 && from_behind(args, i)) args->valid[i] = 0;
  pass_holes(args);
}

struct ExcludingContext {
  rtc::Context context;  // first, so that Embree's pointer to it is one to this
  unsigned excluded;
};

void pass_excluded(const RTCFilterFunctionNArguments* args) {
  const unsigned excluded = reinterpret_cast<const ExcludingContext*>(args->context)->excluded;
  for (unsigned i = 0; i < args->N; ++i) {
    const unsigned top = RTCHitN_instID(args->hit, args->N, i, 0);
    const unsigned id =
        top != RTC_INVALID_GEOMETRY_ID ? top : RTCHitN_geomID(args->hit, args->N, i);
    if (args->valid[i] == -1 && id == excluded) args->valid[i] = 0;
  }
}

void refuse(void* /*user*/, RTCError code, const char* text) {
  if (code == RTC_ERROR_OUT_OF_MEMORY)
    throw WorkError("not enough memory for the ray tracing structures", "use a smaller scene");
  throw WorkError(std::string("Embree reports: ") + text, "please report this as a bug");
}

bool count_memory(void* user, ssize_t bytes, bool /*post*/) {
  static_cast<std::atomic<std::ptrdiff_t>*>(user)->fetch_add(bytes);
  return true;
}

RTCRay embree_ray(const Vec3& origin, const Vec3& direction, float t_min, float t_max) {
  RTCRay ray{};
  ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
  ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
  ray.tnear = t_min, ray.tfar = t_max;
  ray.mask = 0xffffffffu;
  return ray;
}

// Embree reads 16 bytes at every vertex, so the last one needs four bytes behind it.
void give_positions(RTCGeometry geometry, const std::vector<Vec3>& positions) {
  if (positions.capacity() > positions.size()) {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               positions.data(), 0, sizeof(Vec3), positions.size());
  } else {
    void* copy = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                         sizeof(Vec3), positions.size());
    std::copy(positions.begin(), positions.end(), static_cast<Vec3*>(copy));
  }
}

const RTCSceneFlags scene_flags = RTC_SCENE_FLAG_ROBUST | rtc::query_filter;

}  // namespace

EmbreeScene::EmbreeScene(const Scene& scene) : scene_(scene), masks_(scene) {
  device_ = rtcNewDevice(nullptr);
  if (!device_) throw WorkError("Embree has no device for this processor", "use one with SSE4.2");
  rtcSetDeviceErrorFunction(device_, refuse, nullptr);
  rtcSetDeviceMemoryMonitorFunction(device_, count_memory, &bytes_);
  top_ = rtcNewScene(device_);
  rtcSetSceneFlags(top_, scene_flags);
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) attach(i);
  attach_spheres();
  rtcCommitScene(top_);
}

EmbreeScene::~EmbreeScene() {
  for (const auto& [key, scene] : shared_) rtcReleaseScene(scene);
  if (top_) rtcReleaseScene(top_);
  if (device_) rtcReleaseDevice(device_);
}

RTCGeometry EmbreeScene::make_triangles(const Instance& instance) {
  const Mesh& mesh = scene_.meshes[instance.mesh];
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  give_positions(geometry, mesh.positions);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.indices.data(), 0, 3 * sizeof(std::uint32_t),
                             mesh.triangle_count());
  const Material& material = scene_.materials[instance.material];
  const AlphaMask* mask = masks_.find(instance.material);
  const bool culls_back = material.unlit > 0 && !material.double_sided;
  if (mask || culls_back) {
    masked_.push_back(std::make_unique<MaskedMesh>(MaskedMesh{&mesh, &material, mask, culls_back}));
    rtcSetGeometryUserData(geometry, masked_.back().get());
    rtcSetGeometryIntersectFilterFunction(geometry, pass_backs_and_holes);
    if (mask) rtcSetGeometryOccludedFilterFunction(geometry, pass_holes);
  }
  rtcCommitGeometry(geometry);
  return geometry;
}

RTCScene EmbreeScene::scene_of(const Instance& instance) {
  RTCScene& shared = shared_[{instance.mesh, instance.material}];
  if (shared) return shared;
  shared = rtcNewScene(device_);
  rtcSetSceneFlags(shared, scene_flags);
  RTCGeometry geometry = make_triangles(instance);
  rtcAttachGeometry(shared, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(shared);
  return shared;
}

void EmbreeScene::attach(std::uint32_t index) {
  const Instance& instance = scene_.instances[index];
  RTCGeometry geometry = nullptr;
  if (instance.world_from_mesh.is_identity()) {
    geometry = make_triangles(instance);
  } else {
    geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, scene_of(instance));
    const Affine& m = instance.world_from_mesh;
    std::array<float, 12> columns{};
    const Vec3d parts[] = {m.x, m.y, m.z, m.t};
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 3; ++r)
        columns[static_cast<std::size_t>(3 * c + r)] = static_cast<float>(parts[c][r]);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
    rtcCommitGeometry(geometry);
  }
  rtcAttachGeometryByID(top_, geometry, index);
  rtcReleaseGeometry(geometry);
}

void EmbreeScene::attach_spheres() {
  if (scene_.spheres.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* out = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, scene_.spheres.size()));
  for (const Sphere& s : scene_.spheres) {
    const float values[] = {s.center.x, s.center.y, s.center.z, s.radius};
    out = std::copy(std::begin(values), std::end(values), out);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(top_, geometry, static_cast<unsigned>(scene_.instances.size()));
  rtcReleaseGeometry(geometry);
}

std::optional<Hit> EmbreeScene::intersect(const Ray& ray) const {
  rtc::Context context;
  rtc::init(context);
  RTCRayHit ray_hit{};
  ray_hit.ray = embree_ray(ray.origin, ray.direction, 0, ray.t_max);
  ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtc::intersect(top_, context, ray_hit);
  const RTCHit& hit = ray_hit.hit;
  return hit_of(ray_hit.ray.tfar, hit.u, hit.v, hit.primID, hit.geomID, hit.instID[0]);
}

void EmbreeScene::intersect(std::span<const Ray> rays, std::optional<Hit>* hits) const {
  rtc::Context context;
  rtc::init(context);
  RTCRayHit8 packet;
  alignas(32) int valid[8];
  for (std::size_t i = 0; i < 8; ++i) {
    const Ray& ray = rays[std::min(i, rays.size() - 1)];
    valid[i] = i < rays.size() ? -1 : 0;
    packet.ray.org_x[i] = ray.origin.x, packet.ray.org_y[i] = ray.origin.y;
    packet.ray.org_z[i] = ray.origin.z, packet.ray.tnear[i] = 0;
    packet.ray.dir_x[i] = ray.direction.x, packet.ray.dir_y[i] = ray.direction.y;
    packet.ray.dir_z[i] = ray.direction.z, packet.ray.tfar[i] = ray.t_max;
    packet.ray.time[i] = 0, packet.ray.mask[i] = 0xffffffffu;
    packet.ray.id[i] = 0, packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  rtc::intersect(valid, top_, context, packet);
  const RTCHit8& hit = packet.hit;
  for (std::size_t i = 0; i < rays.size(); ++i)
    hits[i] = hit_of(packet.ray.tfar[i], hit.u[i], hit.v[i], hit.primID[i], hit.geomID[i],
                     hit.instID[0][i]);
}

std::optional<Hit> EmbreeScene::hit_of(float t, float u, float v, unsigned primitive,
                                       unsigned geometry, unsigned instance) const {
  if (geometry == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const unsigned top = instance != RTC_INVALID_GEOMETRY_ID ? instance : geometry;
  const auto spheres = static_cast<unsigned>(scene_.instances.size());
  if (top == spheres) return Hit{t, 0, 0, {spheres + primitive, 0}};
  return Hit{t, u, v, {top, primitive}};
}

bool EmbreeScene::occluded(const ShadowRay& ray, int excluded) const {
  ExcludingContext context{{}, static_cast<unsigned>(excluded)};
  rtc::init(context.context);
  RTCRay shadow = embree_ray(ray.origin, ray.direction, ray.t_min, ray.t_max);
  rtc::occluded(top_, context.context, excluded >= 0 ? pass_excluded : nullptr, shadow);
  return shadow.tfar < 0;
}

void EmbreeScene::occluded(const int* valid, RTCRay8& rays, int excluded) const {
  ExcludingContext context{{}, static_cast<unsigned>(excluded)};
  rtc::init(context.context);
  rtc::occluded(valid, top_, context.context, excluded >= 0 ? pass_excluded : nullptr, rays);
}

std::size_t EmbreeScene::memory_bytes() const {
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(bytes_, 0));
}

}  // namespace penumbra
