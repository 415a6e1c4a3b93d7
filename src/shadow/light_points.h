// The points of one light as one receiver sees them: directions, distances, weights.
#pragma once

#include "geometry/world.h"
#include "shadow/light_samples.h"
#include "shadow/light_view.h"

namespace penumbra {

/// Where a shadow ray goes and what it stands for.
struct LightTarget {
  Vec3 direction;    ///< unit
  float t_max = 0;   ///< occluders short of this count
  float weight = 0;  ///< see LightPoint::weight
};

/// How far in front of a flat light's plane an occluder may be computed that lies on it, metres,
/// across the plane: the error of the place on the light, the lift of the rays' origin off the
/// receiver, and the error of what they meet, which is as large as the receiver's coordinates.
inline float on_plane_epsilon(const World& world, const Vec3& on_light, const Vec3& receiver) {
  return 2 * (world.epsilon_at(on_light) + world.epsilon_at(receiver));
}

/// Makes the targets of one light for one receiver. Sphere lights and suns by solid angle, disk,
/// rect and mesh lights by area, segments by length. `epsilon`: metres in front of a flat light
/// that are still on it. Cheap to construct; not thread-safe.
class LightPoints {
 public:
  LightPoints(const LightViews& lights, std::size_t light, const Vec3& point, float epsilon);
  /// Target `i` of a pattern.
  LightTarget target(const SamplePattern& pattern, int i) const;

 private:
  LightTarget on_cone(Vec2 disk) const;
  LightTarget on_surface(const Vec3& p, const Vec3& normal, float area, bool both_sides) const;
  LightTarget on_mesh(Vec2 square) const;

  const Light& light_;
  const MeshLight& mesh_;
  Vec3 point_;
  float epsilon_;
  Frame frame_;                 ///< sphere, sun: w to the centre; disk: w along the normal
  float one_minus_cosine_ = 0;  ///< sphere, sun: of the half-angle
  float distance_ = INFINITY;   ///< sphere: to the centre
  float area_ = 0;              ///< rect, disk, mesh: that can be seen
  bool all_faces_ = false;
};

}  // namespace penumbra
