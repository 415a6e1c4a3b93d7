// How bright to show a picture, from the scene and the camera alone.
#pragma once

#include <vector>

#include "render/camera_rays.h"
#include "render/direct_light.h"
#include "render/material_lookup.h"

namespace penumbra {

/// Luminances of a coarse picture's pixels by what they show.
struct SeenLuminances {
  std::vector<float> all, lit;  ///< surfaces that reflect; those of them that a light reaches
  std::vector<float> emission;  ///< surfaces that emit
};

/// The rule of find_brightness.
float exposure_from(const SeenLuminances& seen, const Vec3& background);
/// Ambient light where the file says nothing of it.
Vec3 automatic_ambient(float exposure_ev);

struct Brightness {
  float exposure_ev = 0;
  Vec3 ambient;  ///< radiance
};

/// The exposure in EV (display value = radiance · 2^EV) at which the 90th percentile of the
/// luminance of lit surfaces shows as 0.8.
///
/// A coarse grid of 64 × 36 rays is shaded with ambient light and with `hard` shadows, whatever
/// method the picture uses, so that it is the same for every method, and a lamp behind a wall does
/// not count. `camera` must be aimed at a picture of 64 × 36 (CameraRays). Emitting surfaces are
/// left out. Surfaces that some light reaches count alone if they are a hundredth of what is seen;
/// else all surfaces count; where none reflects the background counts, then emission. 0 where all
/// is black. Multiplying all light by 2 lowers it by 1; the scene's scale does not matter.
///
/// Where the file says nothing of ambient light (Scene::ambient_is_automatic), the exposure is
/// found without it, and it is 0.12 of the radiance that shows as 0.8: enough to tell things in the
/// dark from one another, whatever the unit of the lights.
Brightness find_brightness(const World& world, const CameraRays& camera, const DirectLight& lights,
                           const MaterialLookup& materials);

inline constexpr int exposure_grid_width = 64, exposure_grid_height = 36;

}  // namespace penumbra
