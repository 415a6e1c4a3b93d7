// The published soft shadows of distance fields: marches from the shaded point to the light.
#include <algorithm>
#include <cmath>

#include "sdf/march.h"
#include "shadow/shadows.h"

namespace penumbra {
namespace {

sdf::ShadowMarch march_of(const ShadowOptions& options) {
  switch (options.kind) {
    case ShadowKind::hard:
      return sdf::ShadowMarch::hard;
    case ShadowKind::sdf_classic:
      return options.variant == SdfVariant::blog ? sdf::ShadowMarch::blog
                                                 : sdf::ShadowMarch::classic;
    case ShadowKind::sdf_inner:
      return options.variant == SdfVariant::abs ? sdf::ShadowMarch::inner_abs
                                                : sdf::ShadowMarch::inner;
    default:
      return sdf::ShadowMarch::improved;
  }
}

/// Where a ray leaves a box enlarged on every side by its diagonal; 0 outside.
float way_out(const Bounds& bounds, const Vec3& origin, const Vec3& direction) {
  const Vec3 margin(bounds.diagonal());
  float far = INFINITY;
  for (int axis = 0; axis < 3; ++axis) {
    const float side =
        direction[axis] > 0 ? bounds.hi[axis] + margin[axis] : bounds.lo[axis] - margin[axis];
    const float t = (side - origin[axis]) / direction[axis];
    if (!std::isnan(t)) far = std::min(far, t);
  }
  return std::max(far, 0.0f);
}

// The blog's loop ends there.
constexpr float blog_maxt = 150;
// A light without size; h / (w t) is then endless or a hit.
constexpr float least_w = 1e-12f;

}  // namespace

void Shadows::field_marches(std::span<const Receiver> receivers, std::size_t light,
                            std::span<Visibility> out, ShadowCounts& counts) const {
  thread_local std::vector<sdf::ShadowRay> rays;
  thread_local std::vector<std::size_t> asked;
  thread_local std::vector<sdf::ShadowResult> results;
  rays.clear(), asked.clear();
  const sdf::ShadowMarch march = march_of(options_);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const auto view = lights_.view(light, receivers[i].position);
    out[i] = {0, 0};
    if (!view) continue;
    sdf::ShadowRay ray;
    ray.origin = receivers[i].position;
    ray.direction = view->direction;
    ray.mint = options_.mint;
    ray.w = std::max(options_.k ? 1 / *options_.k : view->diameter_over_distance / 2, least_w);
    ray.maxt = std::isinf(view->distance) ? way_out(world_.sun_bounds(), ray.origin, ray.direction)
                                          : view->distance;
    if (march == sdf::ShadowMarch::blog) ray.maxt = std::min(ray.maxt, blog_maxt);
    rays.push_back(ray);
    asked.push_back(i);
  }
  results.resize(rays.size());
  sdf::shadow(world_.field(), march, rays, results, {.steps = options_.steps});
  for (std::size_t k = 0; k < rays.size(); ++k) {
    Visibility& v = out[asked[k]];
    v.fraction = results[k].visible_fraction;
    v.steps = results[k].steps;
    counts.march_steps += results[k].steps;
    counts.unfinished_marches += results[k].out_of_steps;
  }
  counts.marches += rays.size();
}

}  // namespace penumbra
