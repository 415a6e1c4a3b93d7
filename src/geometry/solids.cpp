// Distance-field objects among the surfaces that rays meet.
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/embree_scene.h"
#include "geometry/world.h"
#include "scene/extent.h"
#include "sdf/march.h"

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

}  // namespace

std::uint64_t World::march(std::span<const Ray> rays, std::optional<Hit>* hits) const {
  std::uint64_t lost = 0;
  constexpr std::size_t at_once = 16;
  for (std::size_t first = 0; first < rays.size(); first += at_once) {
    const std::size_t count = std::min(at_once, rays.size() - first);
    std::array<sdf::MarchRay, at_once> marches;
    std::array<sdf::MarchHit, at_once> found;
    for (std::size_t i = 0; i < count; ++i) {
      const Ray& ray = rays[first + i];
      const auto& known = hits[first + i];
      marches[i] =
          march_ray(*solids_, extent_, ray.origin, ray.direction, known ? known->t : ray.t_max);
    }
    sdf::trace(*solids_, std::span(marches.data(), count), std::span(found.data(), count),
               {most_steps});
    const auto fields = static_cast<std::uint32_t>(scene_.instances.size() + scene_.spheres.size());
    for (std::size_t i = 0; i < count; ++i)
      if (found[i].hit) hits[first + i] = Hit{found[i].t, 0, 0, {fields, 0}};
    lost += count_lost({found.data(), count});
  }
  return lost;
}

Surface World::solid_surface(const Ray& ray, const Hit& hit) const {
  Surface s;
  s.position = ray.origin + ray.direction * hit.t;
  Vec3 normal;
  solids_->normal(std::span(&s.position, 1), std::span(&normal, 1));
  // Back onto the surface: the ray's t carries the error of its whole length. Where fields blend or
  // are divided by their slope they grow slower than the way. 64 errors make a difference that
  // rounding does not spoil.
  const float way = 64 * epsilon_at(s.position);
  const Vec3 points[] = {s.position, s.position + normal * way};
  float f[2];
  solids_->distance(points, f);
  s.position = s.position - normal * (f[0] / std::clamp((f[1] - f[0]) / way, 0.1f, 1.0f));
  s.front = dot(normal, ray.direction) < 0;
  s.normal = s.front ? normal : -normal;
  s.shading_normal = s.normal;
  s.smooth_position = s.position;
  sdf::Field::Owner owner{};
  solids_->owners(std::span(&s.position, 1), std::span(&owner, 1));
  s.object = owner.object, s.material = owner.material;
  if (owner.blended) {
    const sdf::SurfaceAt at = solids_->surface(s.position);
    for (const auto& part : at.parts) s.blend.push_back({part.material, part.weight});
    if (!at.parts.empty()) s.material = at.parts.front().material;
  }
  s.primitive = hit.primitive;
  return s;
}

bool World::is_inside(const Vec3& p) const { return solids_ && solids_->distance(p) < 0; }

bool World::occluded(const ShadowRay& ray, int excluded, std::uint64_t* lost) const {
  if (embree_->occluded(ray, excluded)) return true;
  if (!solids_) return false;
  sdf::MarchRay march = march_ray(*solids_, extent_, ray.origin, ray.direction, ray.t_max);
  march.t_min = ray.t_min;
  sdf::MarchHit hit;
  sdf::occluded(*solids_, std::span(&march, 1), std::span(&hit, 1), {most_steps});
  if (lost) *lost += hit.out_of_steps;
  return hit.hit || hit.out_of_steps;
}

void World::occluded(const int* valid, RTCRay8& rays, int excluded, std::uint64_t* lost) const {
  embree_->occluded(valid, rays, excluded);
  if (!solids_) return;
  std::array<sdf::MarchRay, 8> marches;
  std::array<sdf::MarchHit, 8> found;
  std::array<std::size_t, 8> lane{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    if (valid[i] == 0 || rays.tfar[i] < 0) continue;
    marches[count] = march_ray(*solids_, extent_, {rays.org_x[i], rays.org_y[i], rays.org_z[i]},
                               {rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]}, rays.tfar[i]);
    marches[count].t_min = rays.tnear[i];
    lane[count++] = i;
  }
  sdf::occluded(*solids_, std::span(marches.data(), count), std::span(found.data(), count),
                {most_steps});
  for (std::size_t i = 0; i < count; ++i)
    if (found[i].hit || found[i].out_of_steps) rays.tfar[lane[i]] = -INFINITY;
  if (lost) *lost += count_lost({found.data(), count});
}

}  // namespace penumbra
