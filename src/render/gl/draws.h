// The draws that make one sample of a picture.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gl/program.h"
#include "render/camera_rays.h"
#include "render/glsl/light_text.h"
#include "render/render.h"

namespace penumbra {

/// One draw. Lights come a few at a time; with points, one light, some of its points and one
/// generation of reflections at a time: drivers end what takes too many turns.
struct PictureDraw {
  bool base = false;  ///< with ambient light, emission and background; sees depth and normal
  std::size_t light_from = 0, light_count = 0;
  int first_point = 0, last_point = 0, point_total = 0;
  int generation = -1;  ///< −1 = all

  bool by_points() const { return last_point > 0; }
  /// No more points of this light and generation follow.
  bool last_of_points() const { return last_point == point_total; }
};

/// All draws of a sample. `points_at_a_time`: at most so many points in a draw; `generations`: of
/// reflections that can be seen, 1 without mirrors; `lights`: at most so many in a draw.
std::vector<PictureDraw> picture_draws(const Scene& scene, const ShadowOptions& shadows,
                                       int points_at_a_time, int generations,
                                       std::size_t lights = lights_at_a_time);

void set_camera(gl::Program& program, const CameraRays& camera);
void set_draw(gl::Program& program, const PictureDraw& draw, std::span<const ShaderLight> lights);

/// Points on each light that `area` looks at.
int light_point_count(const ShadowOptions& shadows);
/// A light without extent is one point.
bool is_one_point(const Light& light);

}  // namespace penumbra
