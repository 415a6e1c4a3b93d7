#include "bake/stored_surface.h"

#include <algorithm>
#include <array>
#include <map>

#include "bake/barycentric.h"

namespace penumbra::bake {
namespace {

using Corner = std::array<double, 3>;
using Corners = std::array<Corner, 3>;

Corner array_of(const Vec3d& v) { return {v.x, v.y, v.z}; }

}  // namespace

StoredSurface::StoredSurface(const Scene& scene, const std::vector<int>& pages) : scene_(scene) {
  for (const Instance& instance : scene.instances) {
    const bool has_uv = !scene.meshes[instance.mesh].uv[1].empty();
    pages_.push_back(has_uv && instance.material < pages.size() ? pages[instance.material] : -1);
  }
  twins_.resize(pages_.size());
  find_twins();
}

Vec3d StoredSurface::corner(PrimitiveId id, int k) const {
  const Instance& instance = scene_.instances[id.instance];
  const Mesh& mesh = scene_.meshes[instance.mesh];
  const std::uint32_t v = mesh.indices[std::size_t{3} * id.triangle + static_cast<std::size_t>(k)];
  return instance.world_from_mesh.point(Vec3d(mesh.positions[v]));
}

// Both sides of a surface are written from the same corners.
void StoredSurface::find_twins() {
  std::map<Corners, PrimitiveId> first;
  for (std::uint32_t i = 0; i < pages_.size(); ++i) {
    if (pages_[i] < 0) continue;
    const std::size_t count = scene_.meshes[scene_.instances[i].mesh].triangle_count();
    for (std::uint32_t t = 0; t < count; ++t) {
      const PrimitiveId id{i, t};
      Corners key{array_of(corner(id, 0)), array_of(corner(id, 1)), array_of(corner(id, 2))};
      std::ranges::sort(key);
      const auto [it, is_new] = first.try_emplace(key, id);
      if (is_new) continue;
      for (const auto& [of, other] : {std::pair(id, it->second), std::pair(it->second, id)}) {
        auto& twins = twins_[of.instance];
        if (twins.empty())
          twins.resize(scene_.meshes[scene_.instances[of.instance].mesh].triangle_count(),
                       {PrimitiveId::none, 0});
        twins[of.triangle] = other;
      }
    }
  }
}

Vec2 StoredSurface::uv(PrimitiveId id, const Vec2& b) const {
  const Mesh& mesh = scene_.meshes[scene_.instances[id.instance].mesh];
  const auto at = [&](std::size_t k) {
    return mesh.uv[1][mesh.indices[std::size_t{3} * id.triangle + k]];
  };
  const Vec2 p = at(0), q = at(1), r = at(2);
  return {p.x + b.x * (q.x - p.x) + b.y * (r.x - p.x), p.y + b.x * (q.y - p.y) + b.y * (r.y - p.y)};
}

Vec2 StoredSurface::middle(PrimitiveId id) const { return uv(id, {1.0f / 3, 1.0f / 3}); }

std::optional<PagePoint> StoredSurface::find(PrimitiveId id, const Vec3& position,
                                             const Vec3& normal) const {
  if (id.instance >= pages_.size() || pages_[id.instance] < 0) return std::nullopt;
  const auto front = [&](PrimitiveId of) {
    const Vec3d a = corner(of, 0);
    const double side = dot(cross(corner(of, 1) - a, corner(of, 2) - a), Vec3d(normal));
    return side * (scene_.instances[of.instance].world_from_mesh.determinant() < 0 ? -1 : 1) > 0;
  };
  if (!front(id)) {
    const auto& twins = twins_[id.instance];
    if (twins.empty() || twins[id.triangle].instance == PrimitiveId::none) return std::nullopt;
    id = twins[id.triangle];
    if (!front(id)) return std::nullopt;
  }
  const Vec2 b = barycentric(corner(id, 0), corner(id, 1), corner(id, 2), Vec3d(position));
  return PagePoint{pages_[id.instance], uv(id, b), id};
}

}  // namespace penumbra::bake
