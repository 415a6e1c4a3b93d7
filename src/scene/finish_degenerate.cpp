#include <fmt/core.h>

#include <array>
#include <limits>

#include "scene/finish.h"
#include "scene/finish_steps.h"

namespace penumbra {
namespace {

/// The error that rounding the corners to float leaves in the cross product of edges e and f, per
/// component, to first order; `error` is that of the corners.
Vec3d cross_error(const Vec3d& e, const Vec3d& f, const Vec3d& error) {
  const Vec3d s = abs(e) + abs(f);
  return {error.y * s.z + error.z * s.y, error.z * s.x + error.x * s.z,
          error.x * s.y + error.y * s.x};
}

}  // namespace

bool has_no_area(const Vec3& p, const Vec3& q, const Vec3& r) {
  const Vec3d a(p), e = Vec3d(q) - a, f = Vec3d(r) - a;
  const Vec3d doubled_area = cross(e, f);
  if (dot(doubled_area, doubled_area) < std::numeric_limits<float>::min()) return true;
  constexpr double half_ulp = 0.5 * std::numeric_limits<float>::epsilon();
  const Vec3d error = cross_error(e, f, Vec3d(max(abs(p), max(abs(q), abs(r)))) * half_ulp);
  const Vec3d n = abs(doubled_area);
  return n.x <= error.x && n.y <= error.y && n.z <= error.z;
}

namespace {

std::size_t drop_triangles(Mesh& mesh) {
  auto& v = mesh.indices;
  const auto& p = mesh.positions;
  std::size_t kept = 0;
  for (std::size_t i = 0; i + 2 < v.size(); i += 3) {
    const std::array triangle{v[i], v[i + 1], v[i + 2]};
    if (has_no_area(p[triangle[0]], p[triangle[1]], p[triangle[2]])) continue;
    for (const std::uint32_t index : triangle) v[kept++] = index;
  }
  const std::size_t dropped = mesh.triangle_count() - kept / 3;
  v.resize(kept);
  return dropped;
}

void drop_empty_instances(Scene& scene) {
  std::vector<int> new_index;
  new_index.reserve(scene.instances.size());
  int kept = 0;
  for (const Instance& instance : scene.instances)
    new_index.push_back(scene.meshes[instance.mesh].indices.empty() ? -1 : kept++);
  std::erase_if(scene.instances,
                [&](const Instance& i) { return scene.meshes[i.mesh].indices.empty(); });
  for (Light& light : scene.lights)
    if (light.instance >= 0) light.instance = new_index[light.instance];
}

void drop_unused_meshes(Scene& scene) {
  std::vector<bool> used(scene.meshes.size());
  for (const Instance& instance : scene.instances) used[instance.mesh] = true;
  std::vector<std::uint32_t> new_index(scene.meshes.size());
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) {
    if (!used[i]) continue;
    if (kept != i) scene.meshes[kept] = std::move(scene.meshes[i]);
    new_index[i] = kept++;
  }
  scene.meshes.resize(kept);
  for (Instance& instance : scene.instances) instance.mesh = new_index[instance.mesh];
}

}  // namespace

void drop_degenerate(Scene& scene) {
  std::size_t dropped = 0;
  for (Mesh& mesh : scene.meshes) dropped += drop_triangles(mesh);
  if (dropped > 0)
    scene.report.conversions.push_back(
        fmt::format("dropped {} triangle{} without area", dropped, dropped == 1 ? "" : "s"));
  scene.report.dropped_triangles += dropped;
  drop_empty_instances(scene);
  drop_unused_meshes(scene);
}

}  // namespace penumbra
