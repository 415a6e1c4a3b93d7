#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "scene/finish_steps.h"

namespace penumbra {
namespace {

/// Fourth powers of lengths (squared cross products) must stay within floats, which end at 3e38.
constexpr double kLargest = 1e9;

double largest(const Vec3d& v) { return max_component(abs(v)); }

/// Relative to the parallelepiped its columns could span at most; doubles leave some 1e-16 of it to
/// rounding, and hierarchies multiply many matrices.
bool is_singular(const Affine& a) {
  const double most = length(a.x) * length(a.y) * length(a.z);
  return !(std::abs(a.determinant()) > 1e-12 * most);
}

void check_vertices(const Scene& scene, std::uint32_t mesh, const std::string& file) {
  const auto& positions = scene.meshes[mesh].positions;
  const auto bad =
      std::find_if_not(positions.begin(), positions.end(), [](auto& p) { return is_finite(p); });
  if (bad == positions.end()) return;
  throw InputError({file},
                   fmt::format("{} has a vertex that is not finite (vertex {})",
                               quoted_name(scene, mesh), bad - positions.begin()),
                   "export the model again");
}

void check_transform(const Scene& scene, const Instance& instance, const std::string& file) {
  const Affine& a = instance.world_from_mesh;
  if (!is_finite(a.x) || !is_finite(a.y) || !is_finite(a.z) || !is_finite(a.t))
    throw InputError(
        {file}, fmt::format("the transform of {} is not finite", quoted_name(scene, instance.mesh)),
        "give it finite numbers");
  if (is_singular(a))
    throw InputError({file},
                     fmt::format("the transform of {} is singular: it flattens the mesh",
                                 quoted_name(scene, instance.mesh)),
                     "give it a scale other than zero on every axis");
}

void check_extent(const Scene& scene, const Instance& instance, const Bounds& box,
                  const std::string& file) {
  if (box.empty()) return;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p(corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                  corner & 4 ? box.hi.z : box.lo.z);
    if (largest(instance.world_from_mesh.point(p)) <= kLargest) continue;
    throw InputError({file},
                     fmt::format("{} reaches beyond {:g} metres from the origin",
                                 quoted_name(scene, instance.mesh), kLargest),
                     "scale the scene down");
  }
}

void check_sphere(const Sphere& sphere, const std::string& file) {
  if (!is_finite(sphere.center) || !(sphere.radius > 0))
    throw InputError({file}, "a sphere has a centre that is not finite or a radius not above 0",
                     "give it finite numbers and a positive radius");
  if (!(largest(Vec3d(sphere.center)) + sphere.radius <= kLargest))
    throw InputError({file},
                     fmt::format("a sphere reaches beyond {:g} metres from the origin", kLargest),
                     "scale the scene down");
}

[[noreturn]] void refuse_far(const char* kind, const std::string& name, const std::string& file) {
  throw InputError({file},
                   fmt::format("the {} '{}' lies or reaches beyond {:g} metres from the origin",
                               kind, name, kLargest),
                   "scale the scene down");
}

}  // namespace

void check_cameras_and_lights(const Scene& scene, const std::string& file) {
  const auto near = [](const Vec3& v) { return largest(Vec3d(v)) <= kLargest; };
  for (const Camera& c : scene.cameras)
    if (!near(c.position) || !is_finite(c.look_at) || !(c.ortho_height.value_or(1) <= kLargest))
      refuse_far("camera", c.name, file);
  for (const Light& l : scene.lights)
    if (!near(l.position) || !near(l.edge_u) || !near(l.edge_v) || !(l.radius <= kLargest))
      refuse_far("light", l.name, file);
}

std::string quoted_name(const Scene& scene, std::uint32_t mesh) {
  const std::string& name = scene.meshes[mesh].name;
  return name.empty() ? fmt::format("mesh {}", mesh) : fmt::format("mesh '{}'", name);
}

void check_geometry(const Scene& scene, const std::string& file) {
  std::vector<Bounds> bounds(scene.meshes.size());
  for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) {
    check_vertices(scene, i, file);
    for (const Vec3& p : scene.meshes[i].positions) bounds[i].grow(p);
  }
  for (const Instance& instance : scene.instances) {
    check_transform(scene, instance, file);
    check_extent(scene, instance, bounds[instance.mesh], file);
  }
  for (const Sphere& sphere : scene.spheres) check_sphere(sphere, file);
}

}  // namespace penumbra
