#include "shadow/light_guard.h"

#include <algorithm>

namespace penumbra {
namespace {

// Radius of a sphere round the light's centre that holds all of it.
float reach_of(const LightViews& lights, std::size_t index, const Vec3& center) {
  const Light& light = lights.light(index);
  switch (light.type) {
    case LightType::rect:
      return length(light.edge_u) / 2 + length(light.edge_v) / 2;
    case LightType::segment:
      return length(light.edge_u) / 2;
    case LightType::mesh: {
      const MeshLight& mesh = lights.mesh_light(index);
      return length(mesh.center - center) + mesh.radius;
    }
    default:
      return light.radius;
  }
}

// Anything in the cone ends the search.
const SearchLimit& anything() {
  static const SearchLimit limit{};
  return limit;
}

}  // namespace

bool whole_light_is_seen(const World& world, const LightViews& lights, const Receiver& receiver,
                         std::size_t light, ShadowCounts& counts) {
  return guard_light(world, lights, receiver, light, counts) == LightGuard::seen;
}

LightGuard guard_light(const World& world, const LightViews& lights, const Receiver& receiver,
                       std::size_t light, ShadowCounts& counts) {
  const auto view = lights.view(light, receiver.position);
  if (!view || !world.has_cone_tree() || world.has_solids()) return LightGuard::unknown;
  ConeQuery query;
  query.origin = receiver.position, query.direction = view->direction;
  query.horizon = receiver.normal, query.epsilon = world.epsilon_at(receiver.position);
  query.excluded_instance = view->own_instance;
  query.lower_bound = true;
  float sine = 0;
  if (lights.light(light).type == LightType::sun) {
    sine = std::sin(lights.light(light).angular_diameter / 2);
  } else {
    const Vec3 center = receiver.position + view->direction * view->distance;
    const float reach = reach_of(lights, light, center);
    sine = reach / view->distance;
    query.distance = view->distance + reach;
  }
  // A little wider than the light, against rounding.
  sine *= 1 + 0x1p-16f;
  const float up = dot(view->direction, receiver.normal);
  if (!(sine > 0) || sine > 0.9f || up <= -sine) return LightGuard::unknown;
  query.outer = sine / std::sqrt(1 - sine * sine);
  if (view->flat) {
    query.has_plane = true;
    query.plane_normal = view->plane_normal, query.plane_distance = view->plane_distance;
    const Vec3 center = receiver.position + view->direction * view->distance;
    query.plane_epsilon = on_plane_epsilon(world, center, receiver.position);
  }
  ConeCounts cone;
  const float clearance = world.cone_tree().least_clearance(query, anything(), cone);
  ++counts.cones;
  counts.cone_nodes += cone.nodes, counts.cone_leaves += cone.leaves;
  if (clearance < query.outer) return LightGuard::unknown;
  return up > sine ? LightGuard::seen : LightGuard::unoccluded;
}

}  // namespace penumbra
