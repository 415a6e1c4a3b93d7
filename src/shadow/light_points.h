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

/// Eight targets, coordinate by coordinate.
struct alignas(32) LightPacket {
  static constexpr int size = 8;
  float x[size], y[size], z[size];  ///< unit directions
  float t_max[size];
  float weight[size];
};

/// How far in front of a flat light's plane an occluder may be computed that lies on it, metres,
/// across the plane: the error of the place on the light, the lift of the rays' origin off the
/// receiver, and the error of what they meet, which is as large as the receiver's coordinates.
inline float on_plane_epsilon(const World& world, const Vec3& on_light, const Vec3& receiver) {
  return 2 * (world.epsilon_at(on_light) + world.epsilon_at(receiver));
}

/// Makes the targets of one light for one receiver. Sphere lights and suns by solid angle, disk,
/// rect and mesh lights by area, segments by length. `epsilon`: metres in front of a flat light
/// that are still on it. Cheap to construct, but for a mesh light with many faces
/// along the rim of what is turned to the receiver; not thread-safe.
class LightPoints {
 public:
  LightPoints(const LightViews& lights, std::size_t light, const Vec3& point, float epsilon);

  /// True if packets are made of points of the unit disk, false if of the unit square.
  bool takes_disk() const { return takes_disk_; }
  /// Targets of eight points of a pattern, given as its tables have them: neither turned nor
  /// shifted.
  void packet(const SamplePattern& pattern, const float* x, const float* y, LightPacket& out) const;
  /// Target `i` of a pattern.
  LightTarget target(const SamplePattern& pattern, int i) const;

  /// Mesh light: the point of the unit square's x and y, from the receiver, and its face's normal.
  struct OnFace {
    Vec3 to, normal;
  };
  OnFace on_face(float x, float y) const;

  /// What packets are made from, as seen from the receiver.
  struct Shape {
    enum class Kind : std::uint8_t { cone, plane, faces, line, point };
    Kind kind = Kind::point;
    Vec3 center;             ///< plane, line, point: of the light
    Vec3 u, v, w;            ///< cone: frame about its axis w; plane, line: across the light
    Vec3 normal;             ///< plane
    bool two_sided = false;  ///< faces
    float epsilon = 0;
    float one_minus_cosine = 0;             ///< cone: of the half-angle
    float distance = INFINITY, radius = 0;  ///< cone: of the sphere, infinite for a sun; line
    float area = 0;                         ///< plane, faces: that can be seen
    float solid_angle = 0;                  ///< cone: weight of each point
  };
  const Shape& shape() const { return shape_; }

 private:
  void set_cone(const Light& light);
  void set_faces(const MeshLight& mesh, bool double_sided);

  Vec3 point_;
  Shape shape_;
  bool takes_disk_ = false;
  const MeshLight* mesh_ = nullptr;
  std::vector<MeshLight::Run> runs_;  ///< of the faces that count
};

}  // namespace penumbra
