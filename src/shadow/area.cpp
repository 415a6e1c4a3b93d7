// The area light itself, by points: the reference.
#include <algorithm>
#include <cmath>

#include "geometry/embree_scene.h"
#include "shadow/adaptive_area.h"
#include "shadow/light_guard.h"
#include "shadow/shadows.h"

namespace penumbra {
namespace {

// A cone costs about as much as this many rays.
constexpr int worth_a_cone = 4;

struct Scratch {
  std::vector<ShadowRay> rays;
  std::vector<std::size_t> point_of_ray;
  std::vector<std::uint8_t> blocked;
};

}  // namespace

Visibility Shadows::light_points(const Receiver& receiver, std::size_t light, std::uint64_t stream,
                                 std::vector<LightPoint>& points, ShadowCounts& counts) const {
  if (adaptive_ && !is_point(lights_.light(light))) {
    const auto first = adaptive_->first(receiver, light, stream, counts);
    return adaptive_->finish(receiver, light, stream, first, true, points, counts);
  }
  thread_local Scratch scratch;
  points.clear();
  if (options_.skip_lit && samples_.count() >= worth_a_cone &&
      whole_light_is_seen(world_, lights_, receiver, light, counts))
    return {1, 0};
  scratch.rays.clear(), scratch.point_of_ray.clear();
  const Light& source = lights_.light(light);
  const float epsilon = world_.epsilon_at(receiver.position);
  const Vec3 origin = receiver.position + receiver.normal * epsilon;
  const LightPoints make(lights_, light, receiver.position,
                         on_plane_epsilon(world_, source.position, receiver.position));
  const SamplePattern pattern = samples_.pattern(hash(stream, light));
  const int count = is_point(source) ? 1 : samples_.count();
  for (int i = 0; i < count; ++i) {
    const LightTarget target = make.target(pattern, i);
    points.push_back({target.direction, target.weight, false});
    // The part of a light below the horizon is hidden.
    if (dot(target.direction, receiver.normal) <= 0) continue;
    scratch.rays.push_back({origin, target.direction, 0, std::max(target.t_max, 0.0f)});
    scratch.point_of_ray.push_back(points.size() - 1);
  }
  scratch.blocked.resize(scratch.rays.size());
  const int own = source.type == LightType::mesh ? source.instance : -1;
  world_.embree().occluded(scratch.rays, own, scratch.blocked.data());
  int visible = 0;
  for (std::size_t i = 0; i < scratch.rays.size(); ++i)
    if (!scratch.blocked[i]) points[scratch.point_of_ray[i]].visible = true, ++visible;
  counts.rays += scratch.rays.size();
  const float n = static_cast<float>(count), p = static_cast<float>(visible) / n;
  // Binomial: an upper bound for stratified points.
  return {p, count > 1 ? std::sqrt(p * (1 - p) / (n - 1)) : 0};
}

}  // namespace penumbra
