#include "shadow/shadows.h"

#include <algorithm>

#include "geometry/embree_scene.h"
#include "shadow/adaptive_area.h"
#include "shadow/profile.h"

namespace penumbra {

ShadowCounts& ShadowCounts::operator+=(const ShadowCounts& b) {
  rays += b.rays, cones += b.cones, cone_nodes += b.cone_nodes, cone_leaves += b.cone_leaves;
  marches += b.marches, march_steps += b.march_steps;
  unfinished_marches += b.unfinished_marches, unfinished_rays += b.unfinished_rays;
  return *this;
}

Receiver receiver_of(const Surface& surface) {
  if (!surface.smooth) return {surface.position, surface.normal};
  return {surface.smooth_position, surface.shading_normal};
}

Shadows::Shadows(const World& world, const ShadowOptions& options)
    : world_(world),
      options_(options),
      lights_(world.scene()),
      samples_(std::max(options.light_samples > 0 ? options.light_samples : 64, 1), options.seed,
               LightSamples::Order::neighbours),
      limit_(search_limit(options.profile, options.tolerance)) {
  if (options.kind == ShadowKind::area && options.error)
    adaptive_ = std::make_unique<AdaptiveArea>(world, lights_, *options.error, options.seed);
}

Shadows::~Shadows() = default;

Visibility Shadows::visibility(const Receiver& receiver, std::size_t light, std::uint64_t stream,
                               ShadowCounts& counts) const {
  if (options_.kind == ShadowKind::none) return {};
  if (options_.kind == ShadowKind::area) return sampled(receiver, light, stream, nullptr, counts);
  if (marches_field()) {
    Visibility v;
    field_marches(std::span(&receiver, 1), light, std::span(&v, 1), counts);
    return v;
  }
  const auto view = lights_.view(light, receiver.position);
  if (!view || dot(view->direction, receiver.normal) <= 0) return {0, 0};
  const bool soft = options_.kind == ShadowKind::parker && view->diameter_over_distance > 0;
  return {soft ? parker(receiver, *view, counts) : hard(receiver, *view, counts), 0};
}

float Shadows::hard(const Receiver& receiver, const LightView& view, ShadowCounts& counts) const {
  const float epsilon = world_.epsilon_at(receiver.position);
  ShadowRay ray{receiver.position + receiver.normal * epsilon, view.direction, 0, view.distance};
  if (view.flat) {
    // What is on the light's own plane does not occlude: stop short of it, measured across it.
    const float lean = std::max(view.plane_distance / view.distance, 1e-4f);
    const Vec3 center = receiver.position + view.direction * view.distance;
    ray.t_max -= on_plane_epsilon(world_, center, receiver.position) / lean;
  }
  ++counts.rays;
  return world_.occluded(ray, view.own_instance, &counts.unfinished_rays) ? 0.0f : 1.0f;
}

ConeQuery Shadows::cone_query(const Receiver& receiver, const LightView& view) const {
  ConeQuery query;
  query.origin = receiver.position;
  query.direction = view.direction;
  query.distance = view.distance;
  query.outer = view.diameter_over_distance;
  query.horizon = receiver.normal;
  query.epsilon = world_.clearance_epsilon_at(receiver.position);
  query.excluded_instance = view.own_instance;
  if (view.flat) {
    query.has_plane = true;
    query.plane_normal = view.plane_normal;
    query.plane_distance = view.plane_distance;
    const Vec3 center = receiver.position + view.direction * view.distance;
    query.plane_epsilon = on_plane_epsilon(world_, center, receiver.position);
  }
  return query;
}

float Shadows::parker(const Receiver& receiver, const LightView& view, ShadowCounts& counts) const {
  const ConeQuery query = cone_query(receiver, view);
  ConeCounts cone;
  float fraction = 0;
  if (options_.composite == Composite::min) {
    const float clearance = world_.cone_tree().least_clearance(query, limit_, cone);
    fraction = visible_fraction(options_.profile, std::min(clearance / query.outer, 1.0f));
  } else {
    fraction = composite(query, cone);
  }
  ++counts.cones;
  counts.cone_nodes += cone.nodes, counts.cone_leaves += cone.leaves;
  return fraction;
}

float Shadows::composite(const ConeQuery& query, ConeCounts& counts) const {
  thread_local std::vector<ObjectClearance> objects;
  world_.cone_tree().object_clearances(query, objects, counts);
  // In the order of the scene, so that rounding does not depend on the walk.
  std::sort(objects.begin(), objects.end(),
            [](const auto& a, const auto& b) { return a.object < b.object; });
  float product = 1, shadow = 0;
  for (const ObjectClearance& object : objects) {
    const float s = visible_fraction(options_.profile, object.clearance / query.outer);
    product *= s, shadow += 1 - s;
  }
  return options_.composite == Composite::multiply ? product : std::max(1 - shadow, 0.0f);
}

}  // namespace penumbra
