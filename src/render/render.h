// Pictures by Whitted's ray tracing (Whitted 1980): direct light with any shadow method, mirrors,
// ambient light.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "geometry/world.h"
#include "image/image.h"
#include "render/known_light.h"
#include "shadow/shadows.h"

namespace penumbra {

struct RenderOptions {
  int width = 960, height = 540;     ///< pixels, at least 1
  int spp = 4;                       ///< stratified samples per pixel; 1 = the pixel's centre
  std::uint32_t seed = 0;            ///< for sampled shadow methods
  std::optional<float> exposure_ev;  ///< none = from the scene (exposure.h)
  int camera = 0;                    ///< index into Scene::cameras
  ShadowOptions shadows;
  const KnownLight* known = nullptr;   ///< heckbert_herf: light that was baked before; else null
  sdf::ConversionOptions conversions;  ///< OpenGL: of meshes; a World has its own
  int mirror_depth = 5;                ///< reflections followed, 0 = none
  float time = 0;                      ///< of shaders: iTime, seconds
  bool want_visibility = false, want_depth = false, want_normal = false, want_error = false,
       want_steps = false;
};

struct RenderStats {
  double seconds_build = 0;   ///< lights, texture pyramids, exposure; the World is timed by whoever
                              ///< builds it, and added here
  double seconds_render = 0;  ///< the tiles
  std::uint64_t primary_rays = 0, mirror_rays = 0;
  std::uint64_t unfinished_rays = 0;  ///< of those: ran out of steps, they see the background
  ShadowCounts shadows;               ///< of the picture, without the exposure's few
  float exposure_ev = 0;              ///< given or chosen; display value = color · 2^EV
  Vec3 ambient;                       ///< OpenGL: radiance of the ambient light
  std::string device;                 ///< the OpenGL renderer's name; empty = this processor
  std::uint64_t field_steps = 0;      ///< OpenGL: evaluations of the field along rays and marches
  std::uint64_t unfinished = 0;       ///< OpenGL: samples with a march that ran out of steps
};

struct RenderResult {
  Image color;                    ///< linear rgb radiance, not exposed
  std::vector<Image> visibility;  ///< by light, 1 channel: mean visible fraction of what the pixel
                                  ///< sees; where it sees nothing that counts as 1
  Image depth;   ///< 1 channel: mean distance along the rays that met something; infinity if none
  Image normal;  ///< 3 channels: mean shading normal, unit; zero where nothing was met
  Image error;   ///< 1 channel: estimated standard error of the pixel's visible fraction, the
                 ///< greatest over the lights; 0 for methods without sampling
  Image steps;   ///< 1 channel: steps of the sdf_* marches, mean over the samples that met
                 ///< something, summed over the lights
  RenderStats stats;
  std::vector<std::string> warnings;  ///< what a person should know of the picture
};

/// Of a camera inside a distance field.
inline constexpr const char* warning_of_blind_eye =
    "the camera is inside a solid: the picture is black there; move the camera out";

/// Renders world.scene(). Analytic lights light surfaces but are not seen themselves, neither
/// directly nor in mirrors; emissive surfaces are. Mirrors are followed to `mirror_depth` as long
/// as more than 1/500 of what they show arrives, then black. From inside a distance field all is
/// black, with a warning. The bytes of the result depend on
/// world and options alone, not on threads. Threads: parallel_for. Throws InputError for a size,
/// sample count or camera that cannot be, Cancelled when asked to stop.
RenderResult render(const World& world, const RenderOptions& options, Progress& progress);

}  // namespace penumbra
