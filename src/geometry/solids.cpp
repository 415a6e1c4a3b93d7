// Distance-field objects among the surfaces that rays meet.
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/embree_scene.h"
#include "geometry/world.h"
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

/// The ray as far as there can be anything; unbounded fields are seen to a thousand times the size
/// of what is bounded and of the way to it.
sdf::MarchRay march_ray(const sdf::Field& field, const Vec3& origin, const Vec3& direction,
                        float t_max) {
  const Bounds& box = field.bounds();
  float far = 0;
  if (field.is_bounded()) {
    far = exit_of(box, origin, direction);
  } else {
    const float size = box.empty() ? 1 : box.diagonal() + length(box.center() - origin);
    far = 1000 * (size + length(origin));
  }
  return {origin, 0, direction, std::min(t_max, far)};
}

// Of the side that the ray met. Differences near an edge reach round it, to a side that faces away;
// a little before the surface, by four times their width, they do not.
Vec3 normal_met(const sdf::Field& field, const Vec3& p, const Vec3& direction) {
  const auto normal_at = [&](const Vec3& q) {
    Vec3 n;
    field.normal(std::span(&q, 1), std::span(&n, 1));
    return n;
  };
  const Vec3 there = normal_at(p);
  if (dot(there, direction) < 0) return there;
  const Vec3 before = normal_at(p - direction * (4 * sdf::Field::normal_step(p)));
  return dot(before, direction) < 0 ? before : there;
}

// Longer than any ray needs that is not lost in a crevice.
constexpr int most_steps = 65535;

}  // namespace

void World::march(std::span<const Ray> rays, std::optional<Hit>* hits) const {
  constexpr std::size_t at_once = 16;
  for (std::size_t first = 0; first < rays.size(); first += at_once) {
    const std::size_t count = std::min(at_once, rays.size() - first);
    std::array<sdf::MarchRay, at_once> marches;
    std::array<sdf::MarchHit, at_once> found;
    for (std::size_t i = 0; i < count; ++i) {
      const Ray& ray = rays[first + i];
      const auto& known = hits[first + i];
      marches[i] = march_ray(*solids_, ray.origin, ray.direction, known ? known->t : ray.t_max);
    }
    sdf::trace(*solids_, std::span(marches.data(), count), std::span(found.data(), count),
               {most_steps});
    const auto fields = static_cast<std::uint32_t>(scene_.instances.size() + scene_.spheres.size());
    for (std::size_t i = 0; i < count; ++i)
      if (found[i].hit) hits[first + i] = Hit{found[i].t, 0, 0, {fields, 0}};
  }
}

Surface World::solid_surface(const Ray& ray, const Hit& hit) const {
  Surface s;
  s.position = ray.origin + ray.direction * hit.t;
  const Vec3 normal = normal_met(*solids_, s.position, ray.direction);
  // Back onto the surface: the ray's t carries the error of its whole length. Where fields blend or
  // are divided by their slope they grow slower than the way, inside perhaps slower than outside
  // (an ellipsoid's bound), so the slope is taken on the point's own side. 64 errors make a
  // difference that rounding does not spoil.
  const float way = 64 * epsilon_at(s.position);
  const Vec3 points[] = {s.position, s.position + normal * way, s.position - normal * way};
  float f[3];
  solids_->distance(points, f);
  const float rise = f[0] < 0 ? f[0] - f[2] : f[1] - f[0];
  s.position = s.position - normal * (f[0] / std::clamp(rise / way, 0.1f, 1.0f));
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

bool World::occluded(const ShadowRay& ray, int excluded) const {
  if (embree_->occluded(ray, excluded)) return true;
  if (!solids_) return false;
  sdf::MarchRay march = march_ray(*solids_, ray.origin, ray.direction, ray.t_max);
  march.t_min = ray.t_min;
  sdf::MarchHit hit;
  sdf::occluded(*solids_, std::span(&march, 1), std::span(&hit, 1), {most_steps});
  return hit.hit || hit.out_of_steps;
}

void World::occluded(const int* valid, RTCRay8& rays, int excluded) const {
  embree_->occluded(valid, rays, excluded);
  if (!solids_) return;
  std::array<sdf::MarchRay, 8> marches;
  std::array<sdf::MarchHit, 8> found;
  std::array<std::size_t, 8> lane{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    if (valid[i] == 0 || rays.tfar[i] < 0) continue;
    marches[count] = march_ray(*solids_, {rays.org_x[i], rays.org_y[i], rays.org_z[i]},
                               {rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]}, rays.tfar[i]);
    marches[count].t_min = rays.tnear[i];
    lane[count++] = i;
  }
  sdf::occluded(*solids_, std::span(marches.data(), count), std::span(found.data(), count),
                {most_steps});
  for (std::size_t i = 0; i < count; ++i)
    if (found[i].hit || found[i].out_of_steps) rays.tfar[lane[i]] = -INFINITY;
}

}  // namespace penumbra
