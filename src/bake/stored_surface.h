// Where in a stored file's pages a point of a surface is.
#pragma once

#include <optional>
#include <vector>

#include "geometry/world.h"
#include "scene/scene.h"

namespace penumbra::bake {

struct PagePoint {
  int page = 0;
  Vec2 uv;               ///< TEXCOORD_1
  PrimitiveId triangle;  ///< that holds it: the hit one, or its twin on the side that is seen
};

/// Immutable; thread-safe. Keeps a reference to the scene.
class StoredSurface {
 public:
  /// `pages`: by material, −1: holds nothing.
  StoredSurface(const Scene& scene, const std::vector<int>& pages);

  int page(std::size_t instance) const { return pages_[instance]; }  ///< −1: none
  /// TEXCOORD_1 in the middle of a triangle of an instance that has a page.
  Vec2 middle(PrimitiveId triangle) const;
  /// `normal`: geometric, on the side that is seen. A surface with two sides is two triangles in
  /// one place; what is seen decides which of them counts. No value where nothing is stored.
  std::optional<PagePoint> find(PrimitiveId hit, const Vec3& position, const Vec3& normal) const;

 private:
  Vec3d corner(PrimitiveId triangle, int k) const;
  Vec2 uv(PrimitiveId triangle, const Vec2& weights) const;
  void find_twins();

  const Scene& scene_;
  std::vector<int> pages_;                       ///< by instance
  std::vector<std::vector<PrimitiveId>> twins_;  ///< by instance and triangle; empty: has none
};

}  // namespace penumbra::bake
