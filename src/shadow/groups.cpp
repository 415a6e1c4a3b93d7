// Many receivers at once: packets of rays, groups of cones.
#include <algorithm>
#include <array>

#include "geometry/embree_scene.h"
#include "shadow/centre_rays.h"
#include "shadow/profile.h"
#include "shadow/shadows.h"

namespace penumbra {

void Shadows::visibilities(std::span<const Receiver> receivers, std::size_t light,
                           std::span<const std::uint64_t> streams, std::span<Visibility> out,
                           ShadowCounts& counts) const {
  const bool grouped = options_.kind == ShadowKind::parker && options_.composite == Composite::min;
  if (options_.kind == ShadowKind::hard) {
    hard_packets(receivers, light, out, counts);
  } else if (grouped) {
    parker_group(receivers, light, out, counts);
  } else if (marches_field()) {
    field_marches(receivers, light, out, counts);
  } else {
    for (std::size_t i = 0; i < receivers.size(); ++i)
      out[i] = visibility(receivers[i], light, streams[i], counts);
  }
}

void Shadows::parker_group(std::span<const Receiver> receivers, std::size_t light,
                           std::span<Visibility> out, ShadowCounts& counts) const {
  thread_local std::vector<ConeQuery> queries;
  thread_local std::vector<std::uint32_t> asked;
  thread_local std::vector<float> clearances;
  queries.clear(), asked.clear();
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const auto view = lights_.view(light, receivers[i].position);
    out[i] = {0, 0};
    if (!view || dot(view->direction, receivers[i].normal) <= 0) continue;
    if (view->diameter_over_distance > 0) {
      queries.push_back(cone_query(receivers[i], *view));
      asked.push_back(static_cast<std::uint32_t>(i));
    } else {
      out[i].fraction = hard(receivers[i], *view, counts);
    }
  }
  clearances.resize(queries.size());
  ConeCounts cone;
  world_.cone_tree().least_clearances(queries, limit_, clearances, cone);
  for (std::size_t i = 0; i < queries.size(); ++i)
    out[asked[i]].fraction =
        visible_fraction(options_.profile, std::min(clearances[i] / queries[i].outer, 1.0f));
  counts.cones += queries.size();
  counts.cone_nodes += cone.nodes, counts.cone_leaves += cone.leaves;
}

void Shadows::hard_packets(std::span<const Receiver> receivers, std::size_t light,
                           std::span<Visibility> out, ShadowCounts& counts) const {
  const Light& source = lights_.light(light);
  if (source.type == LightType::mesh) {
    for (std::size_t i = 0; i < receivers.size(); ++i)
      out[i] = visibility(receivers[i], light, 0, counts);
    return;
  }
  CentreLight centre;
  centre.endless = source.type == LightType::sun;
  centre.at = centre.endless ? -source.direction : source.position;
  centre.flat = source.type == LightType::disk || source.type == LightType::rect;
  centre.normal = source.normal;
  centre.epsilon = world_.epsilon_at(source.position);
  centre.least_epsilon = world_.epsilon_at({});
  centre.roundings = world_.roundings();
  for (std::size_t first = 0; first < receivers.size(); first += 8) {
    const std::size_t count = std::min<std::size_t>(8, receivers.size() - first);
    RTCRay8 rays;
    alignas(32) std::array<int, 8> valid;
    make_centre_rays(receivers.subspan(first, count), centre, rays, valid.data());
    world_.occluded(valid.data(), rays, -1, &counts.unfinished_rays);
    for (std::size_t i = 0; i < count; ++i) {
      counts.rays += valid[i] != 0;
      out[first + i] = {valid[i] != 0 && rays.tfar[i] >= 0 ? 1.0f : 0.0f, 0};
    }
  }
}

}  // namespace penumbra
