// The area light itself, by points: the reference.
#include <algorithm>
#include <cmath>

#include "geometry/embree_scene.h"
#include "shadow/adaptive_area.h"
#include "shadow/light_guard.h"
#include "shadow/light_rays.h"
#include "shadow/shadows.h"

namespace penumbra {
namespace {

// A cone costs about as much as this many rays.
constexpr int worth_a_cone = 4;

struct Scratch {
  std::vector<LightPacket> targets;
  std::vector<std::uint8_t> visible;
};

void list_points(const Scratch& traced, std::vector<LightPoint>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LightPacket& p = traced.targets[i / LightPacket::size];
    const std::size_t k = i % LightPacket::size;
    points[i] = {{p.x[k], p.y[k], p.z[k]},
                 p.weight[k],
                 (traced.visible[i / LightPacket::size] >> k & 1) != 0};
  }
}

}  // namespace

Visibility Shadows::light_points(const Receiver& receiver, std::size_t light, std::uint64_t stream,
                                 std::vector<LightPoint>& points, ShadowCounts& counts) const {
  return sampled(receiver, light, stream, &points, counts);
}

Visibility Shadows::sampled(const Receiver& receiver, std::size_t light, std::uint64_t stream,
                            std::vector<LightPoint>* points, ShadowCounts& counts) const {
  const bool one_point = is_point(lights_.light(light));
  if (adaptive_ && !one_point) {
    const auto first = adaptive_->first(receiver, light, stream, counts);
    return adaptive_->finish(receiver, light, stream, first, true, points, counts);
  }
  if (points) points->clear();
  LightGuard guard = LightGuard::unknown;
  if (options_.skip_lit && samples_.count() >= worth_a_cone)
    guard = guard_light(world_, lights_, receiver, light, counts);
  if (guard == LightGuard::seen) return {1, 0};
  thread_local Scratch scratch;
  const int count = one_point ? 1 : samples_.count();
  const auto packets = static_cast<std::size_t>(count + LightPacket::size - 1) / LightPacket::size;
  scratch.visible.resize(packets);
  if (points) scratch.targets.resize(packets), points->resize(static_cast<std::size_t>(count));
  const LightRays rays(world_, lights_, receiver, light,
                       samples_.pattern(hash(stream, lights_.pattern_of(light))),
                       guard == LightGuard::unoccluded);
  const int visible =
      rays.trace(rays.table_x(), rays.table_y(), count, points ? scratch.targets.data() : nullptr,
                 scratch.visible.data(), counts);
  if (points) list_points(scratch, *points);
  const float n = static_cast<float>(count), p = static_cast<float>(visible) / n;
  // Binomial: an upper bound for stratified points.
  return {p, count > 1 ? std::sqrt(p * (1 - p) / (n - 1)) : 0};
}

}  // namespace penumbra
