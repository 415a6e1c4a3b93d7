#include "render/gl/draws.h"

#include <algorithm>

#include "render/gl/field_program.h"

namespace penumbra {
namespace {

void set(gl::Program& program, const char* name, const Vec3& v) {
  program.set(name, v.x, v.y, v.z);
}

void add_point_draws(const Scene& scene, std::size_t light, int count, int at_a_time,
                     int generations, std::vector<PictureDraw>& draws) {
  PictureDraw draw;
  draw.light_from = light;
  draw.light_count = 1;
  draw.point_total = is_one_point(scene.lights[light]) ? 1 : count;
  for (draw.generation = 0; draw.generation < generations; ++draw.generation)
    for (int first = 0; first < draw.point_total; first += at_a_time) {
      draw.first_point = first;
      draw.last_point = std::min(first + at_a_time, draw.point_total);
      draws.push_back(draw);
    }
}

}  // namespace

int light_point_count(const ShadowOptions& shadows) {
  return shadows.light_samples > 0 ? shadows.light_samples : 64;
}

bool is_one_point(const Light& light) {
  return light.type == LightType::point ||
         (light.type == LightType::sun && light.angular_diameter == 0) ||
         (light.type == LightType::sphere && light.radius == 0);
}

std::vector<PictureDraw> picture_draws(const Scene& scene, const ShadowOptions& shadows,
                                       int points_at_a_time, int generations, std::size_t lights) {
  std::vector<PictureDraw> draws(1);
  draws[0].base = true;
  if (shadows.kind == ShadowKind::area) {
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
      add_point_draws(scene, i, light_point_count(shadows), points_at_a_time, generations, draws);
    return draws;
  }
  for (std::size_t i = 0; i < scene.lights.size(); i += lights) {
    if (i > 0) draws.emplace_back();
    draws.back().light_from = i;
    draws.back().light_count = std::min(lights, scene.lights.size() - i);
  }
  return draws;
}

void set_camera(gl::Program& program, const CameraRays& camera) {
  set(program, "pnb_eye", camera.origin());
  set(program, "pnb_forward", camera.forward());
  set(program, "pnb_aside", camera.corner());
  set(program, "pnb_step_x", camera.step_x());
  set(program, "pnb_step_y", camera.step_y());
  program.set("pnb_orthographic", camera.orthographic() ? 1 : 0);
}

void set_draw(gl::Program& program, const PictureDraw& draw, std::span<const ShaderLight> lights) {
  set_lights(program, lights.subspan(draw.light_from, draw.light_count));
  program.set("pnb_base", draw.base ? 1 : 0);
  program.set("pnb_generation", draw.generation);
  program.set("pnb_first_point", draw.first_point);
  program.set("pnb_last_point", draw.last_point);
  program.set("pnb_point_total", draw.point_total);
}

}  // namespace penumbra
