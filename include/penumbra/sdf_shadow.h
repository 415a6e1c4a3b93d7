// Soft shadows from a distance field: the published loops, for any distance function.
//
//   Inigo Quilez: Soft shadows in raymarched SDFs (2010, with later improvements by Sebastian
//   Aaltonen and "nurof3n"), and the blog post "Soft shadows with ray marching" with nearly the
//   same idea.
//
// Copy this file into your renderer: it needs nothing but the standard library and allocates
// nothing. `distance(t)` is the field at the shaded point plus t times the unit direction to the
// light, negative inside; march the whole field, the receiver included.
//
//   auto along = [&](float t) { return map(origin + direction * t); };
//   Shadow s = penumbra::sdf_shadow::classic(along, 0.01f, light_distance, w);
//
// w is the tangent of half the angle that the light appears under, D / 2A for a light of diameter D
// at distance A; the k of the first article is 1 / w.
//
// Known failures: `classic` and `improved` have only the outer half of the penumbra, so that the
// umbra is too large; `inner` leaks light through walls thinner than the penumbra, and its step
// limits depend on the scene's scale; all take only one occluder into account.
#pragma once

#include <algorithm>
#include <cmath>

namespace penumbra::sdf_shadow {

/// What a loop found. If `out_of_steps`, the limit of steps ended it before the light or a surface
/// was reached: visible_fraction holds for the way it went.
struct Shadow {
  float visible_fraction;
  int steps;  ///< calls of the distance function
  bool out_of_steps;
};

/// The constants of the articles.
struct Constants {
  int steps = 256;
  float hit = 0.001f;  ///< classic, improved: nearer than this is dark
  float blog_hit = 0.0001f;
  float least_step = 0.005f;  ///< inner
  float most_step = 0.50f;    ///< inner
};

/// The plain march that the soft ones begin from: 0 or 1.
template <class Distance>
Shadow hard(Distance&& distance, float mint, float maxt, const Constants& c = {}) {
  float t = mint;
  int i = 0;
  for (; i < c.steps && t < maxt; ++i) {
    const float h = distance(t);
    if (h < c.hit) return {0, i + 1, false};
    t += h;
  }
  return {1, i, t < maxt};
}

/// res = min(res, h / (w t)).
template <class Distance>
Shadow classic(Distance&& distance, float mint, float maxt, float w, const Constants& c = {}) {
  float res = 1, t = mint;
  int i = 0;
  for (; i < c.steps && t < maxt; ++i) {
    const float h = distance(t);
    if (h < c.hit) return {0, i + 1, false};
    res = std::min(res, h / (w * t));
    t += h;
  }
  return {res, i, t < maxt};
}

/// Aaltonen's: with the sphere before, of radius ph, the closest point is estimated to lie
/// y = h² / 2 ph back along the ray and d = √(h² − y²) from it. That holds while y < h and y < t;
/// elsewhere (spheres that do not cut each other, 0 / 0 over a plane) the guard takes `classic`'s
/// ratio.
template <class Distance>
Shadow improved(Distance&& distance, float mint, float maxt, float w, const Constants& c = {}) {
  float res = 1, ph = 1e20f, t = mint;
  int i = 0;
  for (; i < c.steps && t < maxt; ++i) {
    const float h = distance(t);
    if (h < c.hit) return {0, i + 1, false};
    const float y = h * h / (2 * ph);
    if (y < h && y < t)
      res = std::min(res, std::sqrt(h * h - y * y) / (w * (t - y)));
    else
      res = std::min(res, h / (w * t));
    ph = h;
    t += h;
  }
  return {res, i, t < maxt};
}

/// The last line of the inner loops: a smooth step of res in [−1, 1].
inline float inner_profile(float res) {
  res = std::max(res, -1.0f);
  return 0.25f * (1 + res) * (1 + res) * (2 - res);
}

/// Goes on inside of things, by limited steps.
template <class Distance>
Shadow inner(Distance&& distance, float mint, float maxt, float w, const Constants& c = {}) {
  float res = 1, t = mint;
  int i = 0;
  bool dark = false;
  for (; i < c.steps && t < maxt && !dark; ++i) {
    const float h = distance(t);
    res = std::min(res, h / (w * t));
    t += std::clamp(h, c.least_step, c.most_step);
    dark = res < -1;
  }
  return {inner_profile(res), i, t < maxt && !dark};
}

/// The same with steps of |h|, which the article mentions. It comes to rest on a surface that it
/// meets: then it runs out of steps.
template <class Distance>
Shadow inner_abs(Distance&& distance, float mint, float maxt, float w, const Constants& c = {}) {
  float res = 1, t = mint;
  int i = 0;
  bool dark = false;
  for (; i < c.steps && t < maxt && !dark; ++i) {
    const float h = distance(t);
    res = std::min(res, h / (w * t));
    t += std::abs(h);
    dark = res < -1;
  }
  return {inner_profile(res), i, t < maxt && !dark};
}

/// The blog's order: first on, then the ratio. Its start is ε, its end 150.
template <class Distance>
Shadow blog(Distance&& distance, float epsilon, float maxt, float w, const Constants& c = {}) {
  float res = 1, t = epsilon;
  int i = 0;
  for (; i < c.steps && t < maxt; ++i) {
    const float h = distance(t);
    t += h;
    res = std::min(res, h / (w * t));
    if (h < c.blog_hit) return {0, i + 1, false};
  }
  return {res, i, t < maxt};
}

}  // namespace penumbra::sdf_shadow
