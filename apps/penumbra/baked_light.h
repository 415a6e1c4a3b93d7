// --shadows heckbert-herf: what is baked before a picture is drawn, and points by themselves.
#pragma once

#include <memory>

#include "arguments.h"
#include "bake/light_textures.h"
#include "console.h"
#include "probe_points.h"

namespace penumbra::app {

/// A scene with the light on its surfaces. Not to be moved: its parts refer to one another.
class BakedLight {
 public:
  /// Spheres and distance fields become triangles. Throws InputError for fields without end and for
  /// textures beyond the memory that is free.
  BakedLight(const Scene& scene, const Arguments& arguments, Console& console);
  BakedLight(const BakedLight&) = delete;
  BakedLight& operator=(const BakedLight&) = delete;

  const World& world() const { return world_; }
  const KnownLight& light() const { return *light_; }
  /// Texels times points on the lights that they were lit by.
  std::uint64_t texel_samples() const { return texel_samples_; }

 private:
  Scene scene_;
  bake::Plan plan_;
  World world_;
  std::unique_ptr<bake::LightTextures> light_;
  std::uint64_t texel_samples_ = 0;
};

/// Visible fractions at points, each a receiver of one texel in its tangent plane.
std::vector<float> baked_fractions(const World& world, const Arguments& arguments,
                                   const std::vector<ProbePoint>& points, Console& console);

}  // namespace penumbra::app
