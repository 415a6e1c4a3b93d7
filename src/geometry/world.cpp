#include "geometry/world.h"

#include "geometry/cone_tree.h"
#include "geometry/embree_scene.h"

namespace penumbra {

World::World(const Scene& scene, bool with_cone_tree)
    : scene_(scene),
      bounds_(bounds_of(scene)),
      embree_(std::make_unique<EmbreeScene>(scene)),
      cone_tree_(with_cone_tree ? std::make_unique<ConeTree>(scene) : nullptr) {}

World::~World() = default;

std::optional<Hit> World::intersect(const Ray& ray) const { return embree_->intersect(ray); }

void World::intersect(std::span<const Ray> rays, std::optional<Hit>* hits) const {
  embree_->intersect(rays, hits);
}

float World::epsilon_at(const Vec3& p) const {
  // Eight roundings of 2^-24: a hit point is a sum of three products of coordinates about as large
  // as its own, seen through a normal that was rounded too. Near the origin of a small scene the
  // vertices around it still have the scene's magnitude, a sixteenth of which counts.
  return 0x1p-21f * std::max(max_component(abs(p)), bounds_.diagonal() / 16);
}

std::size_t World::memory_bytes() const { return cone_tree_ ? cone_tree_->memory_bytes() : 0; }

}  // namespace penumbra
