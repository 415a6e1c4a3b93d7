// Many receivers at once: packets of rays, groups of cones.
#include <algorithm>
#include <array>

#include "geometry/embree_scene.h"
#include "shadow/centre_views.h"
#include "shadow/profile.h"
#include "shadow/shadows.h"

namespace penumbra {
namespace {

/// What belongs to so many receivers stays in the nearest cache.
constexpr std::size_t block = 256;

}  // namespace

void Shadows::visibilities(std::span<const Receiver> receivers, std::size_t light,
                           std::span<const std::uint64_t> streams, std::span<Visibility> out,
                           ShadowCounts& counts) const {
  const bool grouped = options_.kind == ShadowKind::parker && options_.composite == Composite::min;
  if (marches_field()) {
    field_marches(receivers, light, out, counts);
  } else if (options_.kind == ShadowKind::hard) {
    hard_packets(receivers, light, out, counts);
  } else if (grouped) {
    parker_group(receivers, light, out, counts);
  } else {
    for (std::size_t i = 0; i < receivers.size(); ++i)
      out[i] = visibility(receivers[i], light, streams[i], counts);
  }
}

CentreLight Shadows::centre_light(const Light& source) const {
  CentreLight centre;
  centre.endless = source.type == LightType::sun;
  centre.at = centre.endless ? -source.direction : source.position;
  centre.diameter = diameter_of(source);
  centre.flat = source.type == LightType::disk || source.type == LightType::rect;
  centre.normal = source.normal;
  centre.epsilon = world_.epsilon_at(source.position);
  centre.roundings = world_.roundings();
  centre.least_epsilon = centre.least_on_plane = world_.epsilon_at({});
  return centre;
}

void Shadows::mesh_queries(std::span<const Receiver> receivers, std::size_t light,
                           ConeBatch& queries, std::vector<std::uint32_t>& which) const {
  which.clear();
  const Light& source = lights_.light(light);
  queries.clear(receivers.size(), lights_.mesh_light(light).flat, source.instance);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const auto view = lights_.view(light, receivers[i].position);
    if (!view || dot(view->direction, receivers[i].normal) <= 0) continue;
    queries.push_back(cone_query(receivers[i], *view));
    which.push_back(static_cast<std::uint32_t>(i));
  }
}

void Shadows::parker_group(std::span<const Receiver> receivers, std::size_t light,
                           std::span<Visibility> out, ShadowCounts& counts) const {
  const Light& source = lights_.light(light);
  if (source.type != LightType::mesh && !(diameter_of(source) > 0))
    return hard_packets(receivers, light, out, counts);
  thread_local ConeBatch queries;
  thread_local std::vector<std::uint32_t> which;
  thread_local std::vector<float> clearances;
  if (source.type == LightType::mesh) {
    mesh_queries(receivers, light, queries, which);
  } else {
    CentreLight centre = centre_light(source);
    centre.least_epsilon = world_.clearance_epsilon_at({});
    find_centre_views(receivers, centre, queries, which);
  }
  clearances.resize(queries.size());
  ConeCounts cone;
  world_.cone_tree().least_clearances(queries, limit_, clearances, cone);
  std::fill(out.begin(), out.end(), Visibility{0, 0});
  const float* outer = queries.column(ConeBatch::outer);
  for (std::size_t i = 0; i < queries.size(); ++i)
    out[which[i]].fraction =
        visible_fraction(options_.profile, std::min(clearances[i] / outer[i], 1.0f));
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
  const CentreLight centre = centre_light(source);
  std::fill(out.begin(), out.end(), Visibility{0, 0});
  for (std::size_t first = 0; first < receivers.size(); first += block) {
    const std::size_t count = std::min(block, receivers.size() - first);
    trace_centre(receivers.subspan(first, count), centre, out.subspan(first, count), counts);
  }
}

void Shadows::trace_centre(std::span<const Receiver> receivers, const CentreLight& light,
                           std::span<Visibility> out, ShadowCounts& counts) const {
  thread_local ConeBatch queries;
  thread_local std::vector<std::uint32_t> which;
  find_centre_views(receivers, light, queries, which);
  RTCRay8 rays{};
  std::fill_n(rays.mask, 8, 0xffffffffu);
  alignas(32) std::array<int, 8> valid;
  // Marches fill their lanes again from all that there are: what Embree leaves goes together.
  std::array<ShadowRay, block> left;
  std::array<std::uint32_t, block> lit;
  std::size_t left_count = 0;
  for (std::size_t first = 0; first < queries.size(); first += 8) {
    write_centre_rays(queries, first, rays, valid.data());
    world_.embree().occluded(valid.data(), rays);
    const std::size_t count = std::min<std::size_t>(8, queries.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_lit = rays.tfar[i] >= 0;
      out[which[first + i]].fraction = is_lit ? 1.0f : 0.0f;
      if (!is_lit || !world_.has_solids()) continue;
      lit[left_count] = which[first + i];
      left[left_count++] = ray_of(rays, i);
    }
  }
  counts.rays += queries.size();
  if (left_count == 0) return;
  std::array<bool, block> blocked{};
  world_.add_blocked_by_solids(std::span(left.data(), left_count),
                               std::span(blocked.data(), left_count), &counts.unfinished_rays);
  for (std::size_t i = 0; i < left_count; ++i)
    if (blocked[i]) out[lit[i]].fraction = 0;
}

}  // namespace penumbra
