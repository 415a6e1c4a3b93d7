// One volume round the cones of many points. Private to the geometry room.
//
// Shaft culling (Haines and Wallace 1991, Shaft Culling for Efficient Ray-Traced Radiosity), with
// the box of the points at one end and the box of the cones' ends at the other: its slice at s is
// (1 − s) · one + s · other, so a box is tested as one cone tests it, by two divisions an axis. For
// a sun the slices grow without end, and s is a distance.
#pragma once

#include "geometry/cone_batch.h"

namespace penumbra {

struct ConeShaft {
  Vec3 from_lo, from_hi;       ///< box of the points
  float inv_lo[3], inv_hi[3];  ///< as in ConeSlabs, of the two faces across an axis
  bool lo_is_near[3], hi_is_far[3];
  float reach = 1;            ///< s at the far end
  Vec3 center;                ///< heights are measured from here
  Vec3 normal_lo, normal_hi;  ///< of the points' horizons
  float lift = 0;             ///< most that the center is above a horizon
  float epsilon = 0;          ///< heights above a horizon up to this are still on it
};

/// One cone round the cones of a few points, for triangles: all of them lie where
/// |x| ≤ slope · z + offset across any axis x of the frame, z ≥ −radius.
struct ConeBundle {
  Frame axis;          ///< w along the cones
  float slope = 0;     ///< tangent of the half-angle that all directions stay within
  float radius = 0;    ///< of the ball of the points round the shaft's center
  float offset = 0;    ///< metres
  bool valid = false;  ///< false: the cones are too wide or point apart

  /// Of the `count` queries from `first` on.
  ConeBundle(const ConeBatch& queries, std::size_t first, std::size_t count, const Vec3& center);
};

}  // namespace penumbra
