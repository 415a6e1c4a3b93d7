#include "scene/finish_steps.h"

namespace penumbra {
namespace {

void flip_winding(Mesh& mesh) {
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

void bake(Mesh& mesh, const Affine& world_from_mesh) {
  const bool mirrored = world_from_mesh.determinant() < 0;
  const double sign = mirrored ? -1 : 1;
  for (Vec3& p : mesh.positions) p = world_from_mesh.point(p);
  for (Vec3& n : mesh.normals) {
    const Vec3d world = world_from_mesh.normal(Vec3d(n)) * sign;
    n = dot(world, world) > 0 ? Vec3(normalize(world)) : Vec3{};
  }
  if (mirrored) flip_winding(mesh);
}

Vec3 face_normal(const Mesh& mesh, std::size_t triangle) {
  const std::uint32_t* v = &mesh.indices[3 * triangle];
  const Vec3 &a = mesh.positions[v[0]], &b = mesh.positions[v[1]], &c = mesh.positions[v[2]];
  return cross(b - a, c - a);
}

/// Unit, or zero if n has no direction.
Vec3 direction_of(const Vec3& n) {
  const Vec3d d(n);
  const double square = dot(d, d);
  return std::isfinite(square) && square > 0 ? Vec3(d / std::sqrt(square)) : Vec3{};
}

void repair_normals(Mesh& mesh) {
  std::vector<bool> missing(mesh.normals.size());
  bool any = false;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    Vec3& n = mesh.normals[i] = direction_of(mesh.normals[i]);
    any |= missing[i] = n == Vec3{};
  }
  if (!any) return;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i)
    if (missing[mesh.indices[i]]) mesh.normals[mesh.indices[i]] += face_normal(mesh, i / 3);
  for (std::size_t i = 0; i < mesh.normals.size(); ++i)
    if (missing[i]) {
      const Vec3 n = direction_of(mesh.normals[i]);
      mesh.normals[i] = n == Vec3{} ? Vec3{0, 1, 0} : n;
    }
}

}  // namespace

void bake_transforms(Scene& scene) {
  std::vector<std::uint32_t> uses(scene.meshes.size());
  for (const Instance& instance : scene.instances) ++uses[instance.mesh];
  for (Instance& instance : scene.instances) {
    if (uses[instance.mesh] != 1 || instance.world_from_mesh.is_identity()) continue;
    bake(scene.meshes[instance.mesh], instance.world_from_mesh);
    instance.world_from_mesh = {};
  }
}

void repair_attributes(Scene& scene) {
  for (Mesh& mesh : scene.meshes) {
    repair_normals(mesh);
    for (auto& set : mesh.uv)
      for (Vec2& uv : set)
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) uv = {};
  }
}

}  // namespace penumbra
