#include "bake/shaft.h"

#include <algorithm>

namespace penumbra::bake {
namespace {

Vec3 to_sample(const SampledLight& light, const LightSample& s, const Vec3& from) {
  return light.kind == EmitterKind::direction ? s.position : s.position - from;
}

}  // namespace

Shaft::Shaft(const Tile& tile, const SampledLight& light, std::span<const LightSample> points,
             const Occluders& occluders)
    : at_infinity(light.kind == EmitterKind::direction),
      tile_middle((tile.corner(0, 0) + tile.corner(1, 1)) * 0.5f),
      tile_half_x(tile.step_x * (0.5f * static_cast<float>(tile.width))),
      tile_half_y(tile.step_y * (0.5f * static_cast<float>(tile.height))) {
  Vec3 corners[4];
  for (int i = 0; i < 4; ++i) {
    corners[i] = tile.corner(i & 1, i >> 1);
    receiver_epsilon = std::max(receiver_epsilon, occluders.epsilon_at(corners[i]));
  }
  float top = 0, sample_epsilon = 0;
  for (const LightSample& s : points) {
    top = std::max(top, dot(tile.normal, to_sample(light, s, tile.origin)));
    if (!at_infinity) sample_epsilon = std::max(sample_epsilon, occluders.epsilon_at(s.position));
  }
  empty = !(top > 0);
  if (empty) return;
  slack = 4 * (receiver_epsilon + sample_epsilon);
  bound_samples(points);
  add(tile.normal, tile.origin, -receiver_epsilon);
  add_side(tile, corners[0], tile.step_x, tile.step_y, light, points);
  add_side(tile, corners[2], tile.step_x, -tile.step_y, light, points);
  add_side(tile, corners[0], tile.step_y, tile.step_x, light, points);
  add_side(tile, corners[1], tile.step_y, -tile.step_x, light, points);
  if (!at_infinity) add(-tile.normal, tile.origin + tile.normal * top, slack);
  if (!at_infinity && samples.diagonal() > length(corners[3] - corners[0]))
    add_along(corners, points);
  if (!light.flat) return;
  light_plane.normal = points.front().normal;
  light_plane.offset = -dot(light_plane.normal, points.front().position);
  // The error of the place on the light, the lift of rays off the receiver, and the error of what
  // they meet there: on_plane_epsilon().
  light_epsilon = 2 * (receiver_epsilon + sample_epsilon);
}

void Shaft::bound_samples(std::span<const LightSample> points) {
  for (const LightSample& s : points) {
    samples.grow(s.position);
    samples_middle += s.position;
  }
  if (!at_infinity) {
    samples_middle = samples.center();
    samples_reach = samples.diagonal() * 0.5f + slack;
    return;
  }
  samples_middle = normalize(samples_middle);
  for (const LightSample& s : points)
    samples_reach = std::max(samples_reach, length(cross(samples_middle, s.position)));
  samples_reach += 1e-6f;  // roundings of the cross product
}

void Shaft::add(const Vec3& normal, const Vec3& through, float tolerance) {
  planes[count++] = {normal, tolerance - dot(normal, through)};
}

// A point at height h over the receiver and inside the side by s has slope s / h from it: the plane
// through side and sample is m − (s / h) n, m being the direction inwards.
void Shaft::add_side(const Tile& tile, const Vec3& through, const Vec3& along, const Vec3& inside,
                     const SampledLight& light, std::span<const LightSample> points) {
  Vec3 m = cross(tile.normal, along);
  if (dot(m, inside) < 0) m = -m;
  m = normalize(m);
  float slope = INFINITY;
  for (const LightSample& s : points) {
    const Vec3 to = to_sample(light, s, through);
    const float h = dot(tile.normal, to);
    if (h > 0) slope = std::min(slope, dot(m, to) / h);
  }
  const Vec3 normal = m - tile.normal * slope;
  const float size = length(normal);
  // A sample in the receiver's plane leans out without end: no plane.
  if (size < 1e6f) add(normal / size, through, slack);
}

// On each side a plane through what is furthest out at either end, then moved until it leaves
// nothing outside.
void Shaft::add_along(const Vec3 corners[4], std::span<const LightSample> points) {
  const Vec3 way = samples_middle - tile_middle;
  const float distance = length(way);
  if (!(distance > 0)) return;
  const Frame frame = frame_around(way / distance);
  for (const Vec3& out : {frame.u, -frame.u, frame.v, -frame.v}) {
    float at_tile = -INFINITY, at_light = -INFINITY;
    for (int i = 0; i < 4; ++i) at_tile = std::max(at_tile, dot(out, corners[i] - tile_middle));
    for (const LightSample& s : points)
      at_light = std::max(at_light, dot(out, s.position - tile_middle));
    const Vec3 inwards = normalize(frame.w * (at_light - at_tile) - out * distance);
    float least = INFINITY;
    for (int i = 0; i < 4; ++i) least = std::min(least, dot(inwards, corners[i]));
    for (const LightSample& s : points) least = std::min(least, dot(inwards, s.position));
    planes[count++] = {inwards, slack - least};
  }
}

bool Shaft::meets(const Vec3& center, float radius) const {
  return std::all_of(planes.begin(), planes.begin() + count,
                     [&](const Plane& p) { return dot(p.normal, center) + p.offset > -radius; });
}

}  // namespace penumbra::bake
