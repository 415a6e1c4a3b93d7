#include "bake/shaft.h"

#include <algorithm>

namespace penumbra::bake {
namespace {

Vec3 to_sample(const SampledLight& light, const LightSample& s, const Vec3& from) {
  return light.kind == EmitterKind::direction ? s.position : s.position - from;
}

}  // namespace

Shaft::Shaft(const Tile& tile, const SampledLight& light, std::span<const LightSample> points,
             const Occluders& occluders) {
  float epsilon = 0, top = 0;
  Vec3 corners[4];
  for (int i = 0; i < 4; ++i) {
    corners[i] = tile.corner(i & 1, i >> 1);
    epsilon = std::max(epsilon, occluders.epsilon_at(corners[i]));
  }
  float sample_epsilon = 0;
  for (const LightSample& s : points) {
    top = std::max(top, dot(tile.normal, to_sample(light, s, tile.origin)));
    if (light.kind == EmitterKind::direction) {
      towards += s.position;
    } else {
      samples.grow(s.position);
      sample_epsilon = std::max(sample_epsilon, occluders.epsilon_at(s.position));
    }
  }
  if (light.kind == EmitterKind::direction && dot(towards, towards) > 0) {
    towards = normalize(towards);
    for (const LightSample& s : points)
      spread = std::max(spread, length(cross(towards, s.position)));
  }
  if (!(top > 0)) {
    empty = true;
    return;
  }
  receiver_epsilon = epsilon;
  add(tile.normal, tile.origin, -epsilon);
  const float slack = 4 * (epsilon + sample_epsilon);
  add_side(tile, corners[0], tile.step_x, tile.step_y, light, points, slack);
  add_side(tile, corners[2], tile.step_x, -tile.step_y, light, points, slack);
  add_side(tile, corners[0], tile.step_y, tile.step_x, light, points, slack);
  add_side(tile, corners[1], tile.step_y, -tile.step_x, light, points, slack);
  if (light.kind != EmitterKind::direction)
    add(-tile.normal, tile.origin + tile.normal * top, slack);
  if (!light.flat) return;
  light_plane.normal = points.front().normal;
  light_plane.offset = -dot(light_plane.normal, points.front().position);
  // The error of the place on the light, the lift of rays off the receiver, and the error of what
  // they meet there: on_plane_epsilon().
  light_epsilon = 2 * (epsilon + sample_epsilon);
}

void Shaft::add(const Vec3& normal, const Vec3& through, float slack) {
  planes[count++] = {normal, slack - dot(normal, through)};
}

// A point at height h over the receiver and inside the side by s has slope s / h from it: the plane
// through side and sample is m − (s / h) n, m being the direction inwards.
void Shaft::add_side(const Tile& tile, const Vec3& through, const Vec3& along, const Vec3& inside,
                     const SampledLight& light, std::span<const LightSample> points, float slack) {
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

bool Shaft::meets(const Vec3& center, float radius) const {
  return std::all_of(planes.begin(), planes.begin() + count,
                     [&](const Plane& p) { return dot(p.normal, center) + p.offset > -radius; });
}

}  // namespace penumbra::bake
