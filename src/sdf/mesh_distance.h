// Distance to a triangle mesh, as a distance grid or anything else gives it.
#pragma once

#include <cstddef>

#include "base/vec.h"

namespace penumbra::sdf {

struct DistanceRange {
  float lo, hi;
};

/// Thread-safe. Signed where the mesh has an inside, negative there.
class MeshDistance {
 public:
  virtual ~MeshDistance() = default;
  /// Fills out[0 … count) with the distances at (x[i], y[i], z[i]), world frame; count ≤ 16.
  virtual void distance(const float* x, const float* y, const float* z, std::size_t count,
                        float* out) const = 0;
  /// Bounds of the distances within `radius` of `center`. As it stands here: for values that change
  /// by no more than the way between two points.
  virtual DistanceRange range(const Vec3& center, float radius) const {
    float d;
    distance(&center.x, &center.y, &center.z, 1, &d);
    return {d - radius, d + radius};
  }
  virtual std::size_t memory_bytes() const = 0;
};

}  // namespace penumbra::sdf
