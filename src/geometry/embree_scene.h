// Rays against the scene's surfaces, through Embree.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/alpha_mask.h"
#include "geometry/embree_shim.h"
#include "geometry/hit.h"
#include "scene/scene.h"

namespace penumbra {

/// A shadow ray: what lies strictly between t_min and t_max along a unit direction.
struct ShadowRay {
  Vec3 origin;
  Vec3 direction;
  float t_min = 0;
  float t_max = INFINITY;
};

/// Ray i of a packet.
inline ShadowRay ray_of(const RTCRay8& rays, std::size_t i) {
  return {{rays.org_x[i], rays.org_y[i], rays.org_z[i]},
          {rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]},
          rays.tnear[i],
          rays.tfar[i]};
}

/// Owns Embree's device and scenes. Immutable once built; queries are thread-safe.
class EmbreeScene {
 public:
  explicit EmbreeScene(const Scene& scene);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  std::optional<Hit> intersect(const Ray& ray) const;
  /// The same for up to eight rays at once: those of neighbouring pixels share their way.
  void intersect(std::span<const Ray> rays, std::optional<Hit>* hits) const;

  /// Whether anything but instance `excluded` (−1: nothing is excluded) blocks the ray.
  bool occluded(const ShadowRay& ray, int excluded = -1) const;

  /// The same for eight rays at once, those with valid[i] == -1, which pays for rays to the points
  /// of one light. Where something blocks, tfar becomes negative; all else is left as it is, so
  /// that a packet can be used again. `valid` is aligned to 32 bytes.
  void occluded(const int* valid, RTCRay8& rays, int excluded = -1) const;

  /// Embree's own memory in bytes, as its device reports it.
  std::size_t memory_bytes() const;
  RTCScene handle() const { return top_; }

 private:
  std::optional<Hit> hit_of(float t, float u, float v, unsigned primitive, unsigned geometry,
                            unsigned instance) const;
  RTCGeometry make_triangles(const Instance& instance);
  void attach(std::uint32_t instance_index);
  void attach_spheres();
  RTCScene scene_of(const Instance& instance);

  const Scene& scene_;
  AlphaMasks masks_;
  RTCDevice device_ = nullptr;
  RTCScene top_ = nullptr;
  std::map<std::pair<std::uint32_t, std::uint32_t>, RTCScene> shared_;  ///< by mesh and material
  std::vector<std::unique_ptr<MaskedMesh>> masked_;
  std::atomic<std::ptrdiff_t> bytes_{0};
};

}  // namespace penumbra
