// Embree alone, at its best: what the methods are measured against.
#pragma once

#include <vector>

#include "geometry/embree_shim.h"
#include "shadow/shadows.h"

namespace penumbra::bench {

/// The same surfaces in one flat Embree scene with default flags: no instances, no filters and no
/// robust edges, all of which cost time.
class FlatScene {
 public:
  explicit FlatScene(const Scene& scene);
  ~FlatScene();
  FlatScene(const FlatScene&) = delete;
  FlatScene& operator=(const FlatScene&) = delete;

  RTCScene handle() const { return scene_; }

 private:
  void attach_triangles(const Scene& scene);
  void attach_spheres(const Scene& scene);

  RTCDevice device_;
  RTCScene scene_;
};

/// Traces rays [first, last) one by one, or in packets of 8 or 16. A ray with tfar < 0 is none.
void trace(RTCScene scene, const std::vector<RTCRay>& rays, std::size_t first, std::size_t last,
           int packet);

/// The rays that `hard` traces to the first light, ready made.
std::vector<RTCRay> hard_rays(const Shadows& shadows, const std::vector<Receiver>& points);

/// Those of `area` without its guard: `count` a point, one behind the other, tfar < 0 where the
/// light's point is below the horizon.
std::vector<RTCRay> area_rays(const Shadows& shadows, const std::vector<Receiver>& points,
                              int count);

}  // namespace penumbra::bench
