// Rays through the pixels of a picture.
#pragma once

#include "geometry/world.h"
#include "scene/scene.h"

namespace penumbra {

/// A ray and how wide its pixel is along it: width + spread · t metres.
struct CameraRay {
  Ray ray;
  float width = 0;
  float spread = 0;
};

/// A camera aimed at a picture of width × height pixels. The vertical field of view is the
/// camera's, the horizontal one follows from the picture's shape; pixels are square.
class CameraRays {
 public:
  CameraRays(const Camera& camera, int width, int height);

  /// The ray through (x, y) in pixels from the picture's top left corner; pixel (i, j) covers
  /// [i, i + 1) × [j, j + 1). An orthographic ray starts in the plane of the camera's position.
  CameraRay at(float x, float y) const;

 private:
  Vec3 origin_, corner_, step_x_, step_y_, forward_;
  float pixel_ = 0;  ///< size of a pixel: metres, or tangent of its angle at the axis
  bool orthographic_ = false;
};

}  // namespace penumbra
