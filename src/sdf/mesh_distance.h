// Distance to a triangle mesh, as a distance grid or anything else gives it.
#pragma once

#include <cstddef>

#include "base/vec.h"

namespace penumbra::sdf {

/// Thread-safe. Signed where the mesh has an inside, negative there.
class MeshDistance {
 public:
  virtual ~MeshDistance() = default;
  /// Fills out[0 … count) with the distances at (x[i], y[i], z[i]), world frame; count ≤ 16. The
  /// values change by no more than the way between two points.
  virtual void distance(const float* x, const float* y, const float* z, std::size_t count,
                        float* out) const = 0;
  virtual std::size_t memory_bytes() const = 0;
};

}  // namespace penumbra::sdf
