#include "device.h"

#include <algorithm>

#include "base/error.h"

namespace penumbra::app {
namespace {

bool given(const Arguments& a, const char* option) {
  return std::find(a.given.begin(), a.given.end(), option) != a.given.end();
}

}  // namespace

bool draws_with_gl(const Arguments& a, const Scene& scene) {
  const bool by_gl = a.device == Device::gl || scene.glsl;
  const bool is_baked = a.render.shadows.kind == ShadowKind::heckbert_herf;
  if (is_baked && a.command == Command::probe && !scene.glsl) return false;
  if (by_gl && is_baked)
    throw InputError("--shadows: OpenGL does not draw heckbert-herf pictures",
                     scene.glsl ? "choose an sdf-* method, hard or area" : "leave out --device gl");
  if (a.device == Device::gl) return true;
  if (!scene.glsl) return false;
  if (a.device == Device::cpu)
    throw InputError({scene.glsl->path}, "shaders are drawn by OpenGL alone",
                     "leave out --device cpu");
  return true;
}

bool is_own_picture(const Arguments& a, const Scene& scene) {
  return (a.command == Command::render || a.command == Command::animate) && a.entry != Entry::map &&
         scene.glsl && read_user_shader(scene.glsl->path, scene.glsl->text).has_main_image;
}

void adapt_to_gl(Arguments& a, const Scene& scene, Console& console) {
  a.render.conversions = a.conversion;
  if (is_own_picture(a, scene)) {
    if (!given(a, "--spp")) a.render.spp = 1;
    for (const char* option : {"--shadows", "--light", "--camera", "--exposure"})
      if (given(a, option))
        console.warn(std::string(option) +
                     " has no effect on mainImage; --entry map takes the shader's map");
    a.render.exposure_ev = 0;
    a.render.want_visibility = a.render.want_depth = a.render.want_normal = false;
    return;
  }
  if (given(a, "--shadows")) return;
  a.render.shadows.kind = ShadowKind::sdf_improved;
  console.remark("shadows: sdf-improved, the default of --device gl");
}

}  // namespace penumbra::app
