#include "bake/world_mesh.h"

namespace penumbra::bake {

WorldMesh::WorldMesh(const Scene& scene, std::uint32_t instance)
    : mesh_(scene.meshes[scene.instances[instance].mesh]),
      instance_(scene.instances[instance]),
      index_(instance),
      mirrored_(instance_.world_from_mesh.determinant() < 0),
      positions_(mesh_.positions),
      vertex_normals_(mesh_.normals) {
  if (const Affine& m = instance_.world_from_mesh; !m.is_identity()) {
    const double sign = mirrored_ ? -1 : 1;
    for (Vec3& p : positions_) p = m.point(p);
    for (Vec3& n : vertex_normals_) n = Vec3(normalize(m.normal(Vec3d(n)) * sign));
  }
  for (std::uint32_t t = 0; t < triangle_count(); ++t) {
    const Vec3d a(corner(t, 0)), b(corner(t, 1)), c(corner(t, 2));
    const Vec3d n = cross(b - a, c - a);
    const double doubled = length(n);
    normals_.push_back(doubled > 0 ? Vec3(n / doubled) : Vec3{0, 1, 0});
    areas_.push_back(static_cast<float>(doubled / 2));
  }
}

std::uint32_t WorldMesh::vertex(std::uint32_t triangle, int k) const {
  const int turned = mirrored_ ? (3 - k) % 3 : k;
  return mesh_.indices[std::size_t{3} * triangle + static_cast<std::size_t>(turned)];
}

Vec3 WorldMesh::corner_normal(std::uint32_t triangle, int k) const {
  return vertex_normals_.empty() ? normals_[triangle] : vertex_normals_[vertex(triangle, k)];
}

bool WorldMesh::is_smooth(std::uint32_t triangle) const {
  if (vertex_normals_.empty()) return false;
  for (int k = 0; k < 3; ++k)
    if (length(corner_normal(triangle, k) - normals_[triangle]) > 1e-3f) return true;
  return false;
}

}  // namespace penumbra::bake
