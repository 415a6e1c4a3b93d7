// A surface seen, with everything about its material looked up.
#pragma once

#include "base/vec.h"

namespace penumbra {

/// Reflected radiance is diffuse / π · irradiance + the glossy lobe (ggx.h) + mirror · what the
/// mirror sees.
struct ShadingPoint {
  Vec3 position;
  Vec3 normal;      ///< unit shading normal, on the viewer's side of the surface
  Vec3 to_viewer;   ///< unit
  Vec3 diffuse;     ///< albedo
  Vec3 specular;    ///< reflectance at normal incidence, F0
  Vec3 mirror;      ///< fraction reflected as by a mirror
  Vec3 emission;    ///< radiance towards the viewer
  float alpha = 1;  ///< GGX roughness: the square of the perceptual one, at least 0.002

  bool is_diffuse() const { return max_component(diffuse) > 0; }
  bool is_glossy() const { return max_component(specular) > 0; }
};

}  // namespace penumbra
