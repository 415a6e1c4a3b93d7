// "Does A see B? How far?": the scene, ready for rays and cones.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "base/affine.h"
#include "base/vec.h"
#include "geometry/hit.h"
#include "scene/scene.h"

namespace penumbra {

/// What shading needs to know about a hit.
struct Surface {
  Vec3 position;         ///< on the surface, to floating-point error
  Vec3 normal;           ///< geometric, unit, towards where the ray came from
  Vec3 shading_normal;   ///< interpolated vertex normal, same side; = normal without vertex normals
  Vec3 smooth_position;  ///< position lifted to the smooth surface that the vertex normals describe
                         ///< (Hanika 2021, Hacking the Shadow Terminator); = position without them
  Vec2 uv[2];            ///< TEXCOORD_0 and _1; zero if absent
  Vec2 uv_per_metre;     ///< for texture filtering: |d uv_0| and |d uv_1| per metre on the surface
  std::uint32_t material = 0;
  std::uint32_t object = 0;
  PrimitiveId primitive;
  bool front = true;    ///< seen from the side the winding says
  bool smooth = false;  ///< has vertex normals, or is a sphere
};

class ConeTree;
class EmbreeScene;

/// Immutable once built; every query is thread-safe. Keeps a reference to the scene.
class World {
 public:
  /// Builds Embree's and our own acceleration structures, in parallel. `with_cone_tree` = false
  /// leaves ours out: then clearance queries must not be asked.
  explicit World(const Scene& scene, bool with_cone_tree = true);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  const Scene& scene() const { return scene_; }
  /// Bounds of all geometry.
  const Bounds& bounds() const { return bounds_; }

  /// The nearest hit with 0 < t < ray.t_max; alpha-masked holes are passed through.
  std::optional<Hit> intersect(const Ray& ray) const;
  /// The same for 1 to 8 rays at once, which pays where they go much the same way.
  void intersect(std::span<const Ray> rays, std::optional<Hit>* hits) const;
  Surface surface(const Ray& ray, const Hit& hit) const;

  /// How far from its true place a computed point near p may be, by floating-point error of
  /// coordinates of that size, metres. Whatever is nearer to a tangent plane lies on it.
  float epsilon_at(const Vec3& p) const;

  const EmbreeScene& embree() const { return *embree_; }
  bool has_cone_tree() const { return cone_tree_ != nullptr; }
  const ConeTree& cone_tree() const { return *cone_tree_; }
  /// Bytes held beyond Embree's own and the scene's.
  std::size_t memory_bytes() const;

 private:
  const Scene& scene_;
  Bounds bounds_;
  std::unique_ptr<EmbreeScene> embree_;
  std::unique_ptr<ConeTree> cone_tree_;
};

}  // namespace penumbra
