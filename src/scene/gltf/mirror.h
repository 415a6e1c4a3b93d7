// When a metal counts as a mirror.
#pragma once

#include "base/vec.h"

namespace penumbra::gltf {

/// How much of the light a metal reflects as a mirror does: a renderer without an environment shows
/// smooth metals black otherwise. For metallic ≥ 0.5 it falls linearly from base colour · metallic
/// at roughness 0 to nothing at roughness 0.15; for less metallic surfaces it is nothing. All
/// arguments in [0, 1].
inline Vec3 mirror_of_metal(const Vec3& base_color, float metallic, float roughness) {
  constexpr float least_metallic = 0.5f, roughest = 0.15f;
  if (metallic < least_metallic || roughness >= roughest) return {};
  return base_color * (metallic * (1 - roughness / roughest));
}

}  // namespace penumbra::gltf
