// Distance-field objects among the surfaces that rays meet.
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/embree_scene.h"
#include "geometry/solid_hits.h"
#include "geometry/world.h"
#include "scene/extent.h"
#include "sdf/march.h"
#include "sdf/met_surface.h"

namespace penumbra {
namespace {

/// Where a ray leaves a box, negative if it misses it.
float exit_of(const Bounds& box, const Vec3& origin, const Vec3& direction) {
  float near = 0, far = INFINITY;
  for (int axis = 0; axis < 3; ++axis) {
    const float inv = 1 / direction[axis];
    float a = (box.lo[axis] - origin[axis]) * inv, b = (box.hi[axis] - origin[axis]) * inv;
    if (a > b) std::swap(a, b);
    // Not a number where the ray runs in a face: no bound.
    near = std::max(near, std::isnan(a) ? near : a), far = std::min(far, std::isnan(b) ? far : b);
  }
  return near <= far ? far * (1 + 0x1p-20f) : -1.0f;
}

/// The ray as far as there can be anything.
sdf::MarchRay march_ray(const sdf::Field& field, const Bounds& extent, const Vec3& origin,
                        const Vec3& direction, float t_max) {
  const float far = field.is_bounded() ? exit_of(field.bounds(), origin, direction)
                                       : sight_in_diagonals * extent.diagonal();
  return {origin, 0, direction, std::min(t_max, far)};
}

std::uint64_t count_lost(std::span<const sdf::MarchHit> hits) {
  return static_cast<std::uint64_t>(std::ranges::count_if(hits, &sdf::MarchHit::out_of_steps));
}

// Longer than any ray needs that is not lost in a crevice.
constexpr int most_steps = 65535;

constexpr std::size_t rays_at_once = 256;
/// Neighbours in Morton's order: four by four of a picture.
constexpr std::size_t rays_of_cone = 16;
/// Tangent of half the angle beyond which a cone stops too early to be worth its way.
constexpr float widest_cone = 0.1f;

/// The axis of the rays' cone, no longer than the longest of them; `slope` grows to hold them all.
/// No way if they have no origin in common, or go apart.
sdf::MarchRay axis_of(std::span<const sdf::MarchRay> rays, float& slope) {
  sdf::MarchRay axis{rays[0].origin, 0, {}, -1};
  Vec3 sum;
  float longest = -1, widest = 0;
  for (const sdf::MarchRay& ray : rays) {
    if (ray.origin != axis.origin) return axis;
    sum += ray.direction;
    longest = std::max(longest, ray.t_max);
  }
  axis.direction = normalize(sum);
  for (const sdf::MarchRay& ray : rays)
    widest = std::max(widest, length(cross(axis.direction, ray.direction)));
  // The sine, as a tangent, with room for rounding.
  widest = 1.01f * widest + 1e-6f;
  if (!(widest < widest_cone)) return axis;
  slope = std::max(slope, widest);
  axis.t_max = longest;
  return axis;
}

/// Rays of one origin that go much the same way start where the cone about them may meet something.
void start_later(const sdf::Field& field, std::span<sdf::MarchRay> rays) {
  std::array<sdf::MarchRay, rays_at_once / rays_of_cone> axes;
  std::array<float, axes.size()> ways;
  const std::size_t count = rays.size() / rays_of_cone;
  if (count == 0) return;
  float slope = 0;
  for (std::size_t i = 0; i < count; ++i)
    axes[i] = axis_of(rays.subspan(i * rays_of_cone, rays_of_cone), slope);
  sdf::clear_ways(field, std::span(axes.data(), count), slope, std::span(ways.data(), count));
  for (std::size_t i = 0; i < count * rays_of_cone; ++i) rays[i].t_min = ways[i / rays_of_cone];
}

/// Marches rays to limit(i), calls met(i, t) for those that meet something, in order, and returns
/// how many ran out of steps.
template <class Limit, class Met>
std::uint64_t march_all(const sdf::Field& field, const Bounds& extent, std::span<const Ray> rays,
                        const Limit& limit, const Met& met) {
  std::array<sdf::MarchRay, rays_at_once> marches;
  std::array<sdf::MarchHit, rays_at_once> found;
  std::uint64_t lost = 0;
  for (std::size_t first = 0; first < rays.size(); first += rays_at_once) {
    const std::size_t count = std::min(rays_at_once, rays.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const Ray& ray = rays[first + i];
      marches[i] = march_ray(field, extent, ray.origin, ray.direction, limit(first + i));
    }
    start_later(field, std::span(marches.data(), count));
    sdf::trace(field, std::span(marches.data(), count), std::span(found.data(), count),
               {most_steps});
    for (std::size_t i = 0; i < count; ++i)
      if (found[i].hit) met(first + i, found[i].t);
    lost += count_lost({found.data(), count});
  }
  return lost;
}

}  // namespace

std::uint64_t World::march(std::span<const Ray> rays, std::optional<Hit>* hits) const {
  const auto fields = static_cast<std::uint32_t>(scene_.instances.size() + scene_.spheres.size());
  return march_all(
      *solids_, extent_, rays, [&](std::size_t i) { return hits[i] ? hits[i]->t : rays[i].t_max; },
      [&](std::size_t i, float t) {
        hits[i] = Hit{t, 0, 0, {fields, 0}};
      });
}

void World::solid_surfaces(std::span<const Ray> rays, std::span<const Hit> hits,
                           std::span<const std::uint32_t> which, std::span<Surface> out) const {
  thread_local std::vector<sdf::MeetingPoint> met;
  thread_local std::vector<Vec3> positions, normals;
  thread_local std::vector<sdf::Field::Owner> owners;
  met.clear();
  for (const std::uint32_t i : which)
    met.push_back({rays[i].origin + rays[i].direction * hits[i].t, rays[i].direction});
  positions.resize(met.size()), normals.resize(met.size()), owners.resize(met.size());
  sdf::surfaces(*solids_, met, point_error(), positions, normals);
  solids_->owners(positions, owners);
  for (std::size_t i = 0; i < which.size(); ++i) {
    Surface& s = out[which[i]];
    s = {};
    s.position = s.smooth_position = positions[i];
    s.front = dot(normals[i], met[i].direction) < 0;
    s.normal = s.shading_normal = s.front ? normals[i] : -normals[i];
    s.object = owners[i].object, s.material = owners[i].material;
    s.primitive = hits[which[i]].primitive;
    if (!owners[i].blended) continue;
    const sdf::SurfaceAt at = solids_->surface(positions[i]);
    for (const auto& part : at.parts) s.blend.push_back({part.material, part.weight});
    if (!at.parts.empty()) s.material = at.parts.front().material;
  }
}

std::uint64_t World::meet_solids(std::span<const Ray> rays, SolidHits& hits) const {
  thread_local std::vector<sdf::MeetingPoint> met;
  hits.ray.clear(), met.clear();
  const std::uint64_t lost = march_all(
      *solids_, extent_, rays, [&](std::size_t i) { return rays[i].t_max; },
      [&](std::size_t i, float t) {
        hits.ray.push_back(static_cast<std::uint32_t>(i));
        met.push_back({rays[i].origin + rays[i].direction * t, rays[i].direction});
      });
  hits.position.resize(met.size()), hits.normal.resize(met.size()), hits.owner.resize(met.size());
  sdf::surfaces(*solids_, met, point_error(), hits.position, hits.normal);
  solids_->owners(hits.position, hits.owner);
  return lost;
}

bool World::is_inside(const Vec3& p) const { return solids_ && solids_->distance(p) < 0; }

bool World::occluded(const ShadowRay& ray, int excluded, std::uint64_t* lost) const {
  bool blocked = embree_->occluded(ray, excluded);
  if (!blocked && solids_) add_blocked_by_solids({&ray, 1}, {&blocked, 1}, lost);
  return blocked;
}

void World::add_blocked_by_solids(std::span<const ShadowRay> rays, std::span<bool> blocked,
                                  std::uint64_t* lost) const {
  std::array<sdf::MarchRay, rays_at_once> marches;
  std::array<sdf::MarchHit, rays_at_once> found;
  for (std::size_t first = 0; first < rays.size(); first += rays_at_once) {
    const std::size_t count = std::min(rays_at_once, rays.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const ShadowRay& ray = rays[first + i];
      marches[i] = march_ray(*solids_, extent_, ray.origin, ray.direction, ray.t_max);
      marches[i].t_min = ray.t_min;
    }
    sdf::occluded(*solids_, std::span(marches.data(), count), std::span(found.data(), count),
                  {most_steps});
    for (std::size_t i = 0; i < count; ++i)
      blocked[first + i] = blocked[first + i] || found[i].hit || found[i].out_of_steps;
    if (lost) *lost += count_lost({found.data(), count});
  }
}

void World::occluded(const int* valid, RTCRay8& rays, int excluded, std::uint64_t* lost) const {
  embree_->occluded(valid, rays, excluded);
  if (!solids_) return;
  std::array<ShadowRay, 8> asked;
  std::array<bool, 8> blocked{};
  std::array<std::size_t, 8> lane{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    if (valid[i] == 0 || rays.tfar[i] < 0) continue;
    asked[count] = ray_of(rays, i);
    lane[count++] = i;
  }
  add_blocked_by_solids(std::span(asked.data(), count), std::span(blocked.data(), count), lost);
  for (std::size_t i = 0; i < count; ++i)
    if (blocked[i]) rays.tfar[lane[i]] = -INFINITY;
}

}  // namespace penumbra
