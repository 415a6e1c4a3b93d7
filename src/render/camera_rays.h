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
  CameraRay at(float x, float y) const {
    const Vec3 aside = corner_ + step_x_ * x + step_y_ * y;
    if (orthographic_) return {{origin_ + aside, forward_}, pixel_, 0};
    return {{origin_, normalize(forward_ + aside)}, 0, pixel_};
  }

  // For shaders: the ray through (x, y) has aside = corner + step_x · x + step_y · y; it goes from
  // origin along forward + aside, an orthographic one from origin + aside along forward.
  const Vec3& origin() const { return origin_; }
  const Vec3& forward() const { return forward_; }
  const Vec3& corner() const { return corner_; }
  const Vec3& step_x() const { return step_x_; }
  const Vec3& step_y() const { return step_y_; }
  bool orthographic() const { return orthographic_; }

 private:
  Vec3 origin_, corner_, step_x_, step_y_, forward_;
  float pixel_ = 0;  ///< size of a pixel: metres, or tangent of its angle at the axis
  bool orthographic_ = false;
};

}  // namespace penumbra
