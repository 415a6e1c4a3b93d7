// Distance to a triangle mesh, as a distance grid or anything else gives it.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

#include "base/affine.h"
#include "scene/scene.h"

namespace penumbra::sdf {

class MeshGrid;

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

  /// The grid that gives the distances, times `scale`, at the points of its own frame.
  struct Placed {
    const MeshGrid* grid;
    Affine grid_from_world;
    float scale;
  };
  /// Nothing if there is no grid.
  virtual std::optional<Placed> placed_grid() const { return {}; }
};

/// The distances to an instance of a scene that is not exact (box, quad, polygon).
using MeshDistances =
    std::function<std::shared_ptr<const MeshDistance>(const Scene&, std::size_t instance)>;

}  // namespace penumbra::sdf
