// A light as its shadow methods see it from one point: its centre, A, D (design words).
#pragma once

#include <optional>
#include <vector>

#include "scene/scene.h"

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

/// One face of a mesh light, world frame.
struct LightFace {
  Vec3 a, b, c;
  Vec3 normal;  ///< unit, by the winding
  float area = 0;
};

/// The surface of a mesh light.
struct MeshLight {
  std::vector<LightFace> faces;
  std::vector<float> areas;  ///< of the faces up to and with each
  bool flat = false;         ///< all faces in one plane, to floating-point error
  bool closed = false;       ///< every edge has two faces: its far side is hidden by its near side

  /// Which faces can light the point: those turned to it; of an open double-sided mesh all; where
  /// none is turned to it all (its visible fraction is defined everywhere, its light is zero).
  bool takes_all(const Vec3& point, bool double_sided) const;
  static bool turned(const LightFace& face, const Vec3& point) {
    return dot(face.normal, point - face.a) > 0;
  }
};

/// All lights of a scene. Immutable; queries are thread-safe. Keeps a reference to the scene.
class LightViews {
 public:
  explicit LightViews(const Scene& scene);

  const Scene& scene() const { return scene_; }
  const Light& light(std::size_t i) const { return scene_.lights[i]; }
  const MeshLight& mesh_light(std::size_t i) const { return meshes_[i]; }

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
