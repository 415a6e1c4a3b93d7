#include "scene/scene.h"

namespace penumbra {

const char* to_string(LightType type) {
  constexpr const char* names[] = {"point", "sphere", "disk", "rect", "segment", "sun", "mesh"};
  return names[static_cast<int>(type)];
}

Bounds bounds_of(const Scene& scene, const Instance& instance) {
  Bounds bounds;
  for (const Vec3& p : scene.meshes[instance.mesh].positions)
    bounds.grow(instance.world_from_mesh.point(p));
  return bounds;
}

Bounds bounds_of(const Scene& scene) {
  Bounds bounds;
  for (const Instance& instance : scene.instances) bounds.grow(bounds_of(scene, instance));
  for (const Sphere& sphere : scene.spheres) {
    bounds.grow(sphere.center - Vec3(sphere.radius));
    bounds.grow(sphere.center + Vec3(sphere.radius));
  }
  for (const SdfTree& tree : scene.sdfs) bounds.grow(bounds_of_finite_parts(tree));
  return bounds;
}

}  // namespace penumbra
