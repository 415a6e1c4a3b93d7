// The glossy lobe: GGX microfacets (Walter et al. 2007) with the height-correlated Smith term
// (Heitz 2014, equation 99) and Schlick's Fresnel factor.
#pragma once

#include <numbers>

#include "base/vec.h"

namespace penumbra {

/// A lobe's value times cos θ, without the reflectance F0 at normal incidence: the reflected
/// radiance is radiance · solid angle · (F0 · f0 + f90).
struct Glossy {
  float f0 = 0, f90 = 0;

  Glossy& operator+=(const Glossy& b) {
    f0 += b.f0, f90 += b.f90;
    return *this;
  }
  friend Glossy operator*(const Glossy& a, float s) { return {a.f0 * s, a.f90 * s}; }
};

/// Half of the angular spacing of a light's points, squared, is added to alpha²: then the lobes of
/// neighbouring points run into each other (2 % ripple) and no point is seen by itself.
inline float widened_alpha2(float alpha, float solid_angle) {
  return std::min(1.0f, alpha * alpha + 0.25f * solid_angle);
}

/// The lobe for unit directions to the viewer and the light: `nv`, `nl` their cosines to the normal
/// (nv > 0), `vl` the cosine between them. Zero for nl ≤ 0.
inline Glossy ggx(float alpha2, float nv, float nl_signed, float vl) {
  const float nl = std::max(nl_signed, 0.0f);
  const float half2 = std::max(2.0f + 2.0f * vl, 1e-6f);
  const float nh2 = std::min((nv + nl) * (nv + nl) / half2, 1.0f);
  const float vh = std::sqrt(std::max(0.5f + 0.5f * vl, 0.0f));
  const float d = 1.0f - nh2 * (1.0f - alpha2);
  const float smith = nl * std::sqrt(nv * nv * (1.0f - alpha2) + alpha2) +
                      nv * std::sqrt(nl * nl * (1.0f - alpha2) + alpha2);
  const float lobe = alpha2 * nl * 0.5f / (std::numbers::pi_v<float> * d * d * smith);
  const float m = 1.0f - vh, m2 = m * m, fresnel = m2 * m2 * m;
  return {lobe * (1.0f - fresnel), lobe * fresnel};
}

}  // namespace penumbra
