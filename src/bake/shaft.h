// What lies between a piece of a receiver and some points of a light.
#pragma once

#include <array>
#include <span>

#include "bake/light_sampler.h"
#include "bake/occluders.h"
#include "bake/tile.h"

namespace penumbra::bake {

/// Points with dot(normal, p) + offset ≥ 0 are on the inside; what is wholly below 0 is out.
struct Plane {
  Vec3 normal;
  float offset = 0;
};

/// A convex region that holds every segment between tile and samples (Haines and Wallace 1991,
/// Shaft Culling for Efficient Ray-Traced Radiosity, here with planes through the sides of the
/// receiver): in front of the receiver, below the highest sample, and within the planes through
/// each side of the tile and the sample that leans out most over it. Those say little where samples
/// are close to the receiver's plane; where the samples are further apart than the tile is wide,
/// four planes along the way from one to the other bound it too.
struct Shaft {
  static constexpr int most = 10;
  int count = 0;
  std::array<Plane, most> planes;  ///< the first is the receiver's; on it counts as out
  /// What lies wholly on the light's plane is out too; a zero normal if the light is not flat.
  Plane light_plane;
  float light_epsilon = 0;
  float receiver_epsilon = 0;  ///< what is nearer to the plane of the receiver lies on it, metres
  float slack = 0;             ///< error of coordinates at both ends, metres
  bool at_infinity = false;    ///< the samples are directions
  Bounds samples;              ///< round them; not at infinity
  Vec3 samples_middle;         ///< of the box; at infinity their mean direction, unit
  float samples_reach = 0;     ///< how far one may be from the middle; at infinity a sine
  Vec3 tile_middle, tile_half_x, tile_half_y;
  bool empty = false;  ///< no sample is in front of the receiver

  Shaft(const Tile& tile, const SampledLight& light, std::span<const LightSample> points,
        const Occluders& occluders);

  /// False for a sphere that is known to be out.
  bool meets(const Vec3& center, float radius) const;

 private:
  void bound_samples(std::span<const LightSample> points);
  void add(const Vec3& normal, const Vec3& through, float tolerance);
  void add_along(const Vec3 corners[4], std::span<const LightSample> points);
  void add_side(const Tile& tile, const Vec3& through, const Vec3& along, const Vec3& inside,
                const SampledLight& light, std::span<const LightSample> points);
};

}  // namespace penumbra::bake
