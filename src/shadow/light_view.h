// A light as its shadow methods see it from one point: its centre, A, D (design words).
#pragma once

#include <optional>
#include <vector>

#include "scene/scene.h"
#include "shadow/mesh_light.h"

namespace penumbra {

/// Whether a light is without extent: to every receiver one point, or one direction.
bool is_point(const Light& light);

/// D of a light without faces, metres; of a sun D / A.
float diameter_of(const Light& light);

struct LightView {
  Vec3 direction;                    ///< unit, from the point to the light's centre
  float distance = INFINITY;         ///< A, to the centre; infinite for a sun
  float diameter_over_distance = 0;  ///< D / A; a sun: 2 tan(half its angular diameter)
  /// Flat lights: what lies on or behind this plane is no occluder.
  bool flat = false;
  Vec3 plane_normal;         ///< unit, towards the point
  float plane_distance = 0;  ///< of the point in front of the plane
  int own_instance = -1;     ///< mesh light: this instance does not occlude
};

/// All lights of a scene. Immutable; queries are thread-safe. Keeps a reference to the scene.
class LightViews {
 public:
  explicit LightViews(const Scene& scene);

  const Scene& scene() const { return scene_; }
  const Light& light(std::size_t i) const { return scene_.lights[i]; }
  const MeshLight& mesh_light(std::size_t i) const { return meshes_[i]; }
  /// By which points on the light are chosen: the same for the colours of one texture, so that
  /// these cast no coloured noise.
  std::size_t pattern_of(std::size_t i) const;

  /// The view of a light from a point: centre, A and D as in Parker's formulas, with D = 2R for
  /// sphere and disk, 2 √(area/π) for rect and mesh, 2 √(2 r L / π) for a segment, 0 for a point.
  /// No value for a light without extent in space (a mesh of no area) or centred on the point
  /// itself.
  std::optional<LightView> view(std::size_t light, const Vec3& point) const;

 private:
  std::optional<LightView> mesh_view(std::size_t light, const Vec3& point) const;

  const Scene& scene_;
  std::vector<MeshLight> meshes_;  ///< per light; empty for the other types
};

}  // namespace penumbra
