#include "bake/coplanar.h"

#include <algorithm>
#include <numeric>

namespace penumbra::bake {
namespace {

constexpr float least_cosine = 0.9962f;  // of 5 degrees

float tolerance_of(const WorldMesh& mesh) {
  Bounds box;
  for (const Vec3& p : mesh.positions()) box.grow(p);
  const float rounding = 0x1p-21f * max_component(max(abs(box.lo), abs(box.hi)));
  return std::max(1e-5f * box.diagonal(), rounding);
}

class Parts {
 public:
  Parts(const WorldMesh& mesh, const Adjacency& adjacency)
      : mesh_(mesh), adjacency_(adjacency), tolerance_(tolerance_of(mesh)) {
    taken_.resize(mesh.triangle_count());
    for (std::uint32_t t = 0; t < taken_.size(); ++t) taken_[t] = mesh.is_smooth(t);
  }

  bool is_taken(std::uint32_t triangle) const { return taken_[triangle]; }

  TriangleIds grow(std::uint32_t seed) {
    TriangleIds part{seed};
    taken_[seed] = true;
    for (std::size_t i = 0; i < part.size(); ++i)
      for (const std::uint32_t t : adjacency_.neighbours(part[i])) {
        if (taken_[t] || !in_plane(t, seed)) continue;
        taken_[t] = true;
        part.push_back(t);
      }
    return part;
  }

 private:
  bool in_plane(std::uint32_t t, std::uint32_t seed) const {
    const Vec3& n = mesh_.normal(seed);
    if (dot(mesh_.normal(t), n) < least_cosine) return false;
    const Vec3d p(mesh_.corner(seed, 0));
    for (int k = 0; k < 3; ++k)
      if (std::abs(dot(Vec3d(mesh_.corner(t, k)) - p, Vec3d(n))) > tolerance_) return false;
    return true;
  }

  const WorldMesh& mesh_;
  const Adjacency& adjacency_;
  float tolerance_;
  std::vector<bool> taken_;
};

}  // namespace

std::vector<TriangleIds> coplanar_parts(const WorldMesh& mesh, const Adjacency& adjacency) {
  TriangleIds order(mesh.triangle_count());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, std::greater{}, [&](std::uint32_t t) { return mesh.area(t); });
  Parts parts(mesh, adjacency);
  std::vector<TriangleIds> found;
  for (const std::uint32_t t : order)
    if (!parts.is_taken(t)) found.push_back(parts.grow(t));
  return found;
}

}  // namespace penumbra::bake
