// "Does A see B? How far?": the scene, ready for rays and cones.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/affine.h"
#include "base/vec.h"
#include "geometry/hit.h"
#include "scene/scene.h"
#include "sdf/convert.h"

struct RTCRay8;

namespace penumbra {

struct ShadowRay;

/// What shading needs to know about a hit.
struct Surface {
  Vec3 position;         ///< on the surface, to floating-point error
  Vec3 normal;           ///< geometric, unit, towards where the ray came from
  Vec3 shading_normal;   ///< interpolated vertex normal, same side; = normal without vertex normals
  Vec3 smooth_position;  ///< position lifted to the smooth surface that the vertex normals describe
                         ///< (Hanika 2021, Hacking the Shadow Terminator); = position without them
  Vec2 uv[2];            ///< TEXCOORD_0 and _1; zero if absent
  Vec2 uv_per_metre;     ///< for texture filtering: |d uv_0| and |d uv_1| per metre on the surface
  Vec3 color{1, 1, 1};   ///< interpolated vertex colour, linear; multiplies diffuse
  std::uint32_t material = 0;
  std::uint32_t object = 0;
  /// Where smooth operators of distance fields blend materials: which, and weights that add up to
  /// 1; empty: `material` alone.
  struct Share {
    std::uint32_t material;
    float weight;
  };
  std::vector<Share> blend;
  PrimitiveId primitive;
  bool front = true;    ///< seen from the side the winding says
  bool smooth = false;  ///< has vertex normals, or is a sphere
};

class ConeTree;
class EmbreeScene;
struct SolidHits;
namespace sdf {
class Field;
struct PointError;
}  // namespace sdf

/// What queries will be asked.
struct WorldOptions {
  bool cone_tree = true;  ///< clearances; distance fields become triangles for that
  bool field = false;     ///< distances to everything; meshes become grids for that
  sdf::ConversionOptions conversions{};
};

/// Immutable once built; every query is thread-safe. Keeps a reference to the scene.
class World {
 public:
  /// Builds Embree's and our own acceleration structures, in parallel.
  explicit World(const Scene& scene, const WorldOptions& options = {});
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  const Scene& scene() const { return scene_; }
  /// Bounds of all geometry, of what has no end the finite parts.
  const Bounds& bounds() const { return bounds_; }
  /// sun_bounds(scene).
  const Bounds& sun_bounds() const { return sun_bounds_; }

  /// The nearest hit with 0 < t < ray.t_max; alpha-masked holes are passed through. Distance fields
  /// are marched to the precision of triangles.
  std::optional<Hit> intersect(const Ray& ray) const;
  /// The same for many rays at once, which pays where they go much the same way.
  /// Returns how many of them met nothing because they ran out of steps in a distance field.
  std::uint64_t intersect(std::span<const Ray> rays, std::optional<Hit>* hits) const;
  Surface surface(const Ray& ray, const Hit& hit) const;
  /// The same for many, which pays on distance fields. Three spans of one size.
  void surfaces(std::span<const Ray> rays, std::span<const Hit> hits, std::span<Surface> out) const;

  /// Whether anything but instance `excluded` (−1: nothing is excluded) blocks the ray.
  /// Rays that run out of steps in a distance field count as blocked, and are added to `lost`.
  bool occluded(const ShadowRay& ray, int excluded = -1, std::uint64_t* lost = nullptr) const;
  /// The same for the rays of a packet with valid[i] == −1, see EmbreeScene::occluded.
  void occluded(const int* valid, RTCRay8& rays, int excluded = -1,
                std::uint64_t* lost = nullptr) const;

  /// What distance-field objects add to that, for many rays at once, which pays where they go much
  /// the same way: `blocked` of those that meet one becomes true. Two spans of one size.
  void add_blocked_by_solids(std::span<const ShadowRay> rays, std::span<bool> blocked,
                             std::uint64_t* lost = nullptr) const;

  /// How far from its true place a computed point near p may be, by floating-point error of
  /// coordinates of that size, metres. Whatever is nearer to a tangent plane lies on it.
  float epsilon_at(const Vec3& p) const;
  /// The same for clearances: the triangles of distance fields stand over hollows that they span.
  float clearance_epsilon_at(const Vec3& p) const;
  /// epsilon_at() per metre of p's greatest coordinate, where that decides.
  float roundings() const;

  const EmbreeScene& embree() const { return *embree_; }
  bool has_cone_tree() const { return cone_tree_ != nullptr; }
  const ConeTree& cone_tree() const { return *cone_tree_; }
  /// True if there are distance-field objects.
  bool has_solids() const { return solids_ != nullptr; }
  /// True if there is nothing else.
  bool has_only_solids() const {
    return has_solids() && scene_.instances.empty() && scene_.spheres.empty();
  }
  /// intersect() and surfaces() for such a world, to the same bits. Returns as intersect() does.
  std::uint64_t meet_solids(std::span<const Ray> rays, SolidHits& hits) const;
  /// Distances to the distance-field objects, if there are any.
  const sdf::Field& solids() const { return *solids_; }
  /// True for a point inside a distance-field object.
  bool is_inside(const Vec3& p) const;
  bool has_field() const { return field_ != nullptr; }
  /// Distances to all there is; with WorldOptions::field only.
  const sdf::Field& field() const { return *field_; }
  /// What a person should know of the distance fields.
  std::vector<std::string> warnings() const;
  /// Bytes held beyond Embree's own and the scene's.
  std::size_t memory_bytes() const;

 private:
  sdf::PointError point_error() const;
  /// What distance fields add to the hits known so far.
  std::uint64_t march(std::span<const Ray> rays, std::optional<Hit>* hits) const;
  bool is_solid(const Hit& hit) const {
    return hit.primitive.instance >= scene_.instances.size() + scene_.spheres.size();
  }
  /// Fills in those of `which`.
  void solid_surfaces(std::span<const Ray> rays, std::span<const Hit> hits,
                      std::span<const std::uint32_t> which, std::span<Surface> out) const;

  const Scene& scene_;
  Bounds bounds_, extent_, sun_bounds_;
  std::unique_ptr<EmbreeScene> embree_;
  std::unique_ptr<const Scene> triangulated_;  ///< with distance fields as triangles; may be null
  float sagitta_ = 0;  ///< how far such triangles may stand over the surface, metres
  std::unique_ptr<ConeTree> cone_tree_;
  std::shared_ptr<const sdf::Field> solids_;  ///< the distance-field objects
  std::shared_ptr<const sdf::Field> field_;   ///< everything
};

}  // namespace penumbra
