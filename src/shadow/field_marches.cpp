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

/// The centre of one light from many points: LightViews::view(), to the same bits.
class Aim {
 public:
  Aim(const LightViews& lights, std::size_t light)
      : lights_(lights),
        index_(light),
        light_(lights.light(light)),
        diameter_(diameter_of(light_)) {}

  /// Sets direction, w and maxt, which is infinite for a sun; false if there is nothing to see.
  bool at(const Vec3& p, sdf::ShadowRay& ray) const {
    if (light_.type == LightType::mesh) {
      const auto view = lights_.view(index_, p);
      if (view) set(ray, view->direction, view->distance, view->diameter_over_distance);
      return view.has_value();
    }
    if (light_.type == LightType::sun) {
      set(ray, -light_.direction, INFINITY, diameter_);
      return true;
    }
    const Vec3 to_light = light_.position - p;
    const float distance = length(to_light);
    if (!(distance > 0)) return false;
    set(ray, to_light / distance, distance, diameter_ / distance);
    return true;
  }

 private:
  static void set(sdf::ShadowRay& ray, const Vec3& direction, float distance, float size) {
    ray.direction = direction, ray.maxt = distance, ray.w = size / 2;
  }
  const LightViews& lights_;
  std::size_t index_;
  const Light& light_;
  float diameter_;
};

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
  const Aim aim(lights_, light);
  const sdf::ShadowMarch march = march_of(options_);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    out[i] = {0, 0};
    sdf::ShadowRay ray;
    if (!aim.at(receivers[i].position, ray)) continue;
    ray.origin = receivers[i].position;
    ray.mint = options_.mint;
    if (options_.k) ray.w = 1 / *options_.k;
    ray.w = std::max(ray.w, least_w);
    if (std::isinf(ray.maxt)) ray.maxt = way_out(world_.sun_bounds(), ray.origin, ray.direction);
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
