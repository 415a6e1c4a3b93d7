// Pictures by OpenGL, and how much they differ from others.
#pragma once

#include <cmath>

#include "geometry/world.h"
#include "image/srgb.h"
#include "render/gl/render_gl.h"
#include "render/render.h"

namespace penumbra::testing {

inline RenderOptions small(ShadowKind kind) {
  RenderOptions options;
  options.width = 96, options.height = 64;
  options.spp = 1;
  options.shadows.kind = kind;
  return options;
}

inline RenderResult drawn_picture(const Scene& scene, const RenderOptions& options,
                                  Entry entry = Entry::automatic) {
  Progress silent;
  return render_gl(scene, options, entry, silent);
}

inline int code(float linear, float ev) { return srgb_encoder()(linear * std::exp2(ev)); }

/// Share of pixels that differ by more than 1/255 as shown.
inline double difference(const RenderResult& a, const RenderResult& b) {
  int far = 0;
  for (std::size_t i = 0; i < a.color.data.size(); i += 3) {
    int most = 0;
    for (std::size_t c = i; c < i + 3; ++c)
      most = std::max(most, std::abs(code(a.color.data[c], a.stats.exposure_ev) -
                                     code(b.color.data[c], b.stats.exposure_ev)));
    far += most > 1;
  }
  return 3.0 * far / static_cast<double>(a.color.data.size());
}

inline const char* name_of(ShadowKind kind) {
  return kind == ShadowKind::hard          ? "hard"
         : kind == ShadowKind::sdf_classic ? "classic"
         : kind == ShadowKind::sdf_inner   ? "inner"
         : kind == ShadowKind::area        ? "area"
         : kind == ShadowKind::none        ? "none"
                                           : "improved";
}

/// The same of the processor's picture and OpenGL's of a scene.
inline double difference(const Scene& scene, RenderOptions options, double voxel_size = 0.05) {
  WorldOptions world_options;
  world_options.cone_tree = false, world_options.field = true;
  world_options.conversions.keep_files = false;
  world_options.conversions.voxel_size = voxel_size;
  options.conversions = world_options.conversions;
  Progress silent;
  const World world(scene, world_options);
  return difference(render(world, options, silent), drawn_picture(scene, options));
}

}  // namespace penumbra::testing
