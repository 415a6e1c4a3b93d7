#include "report/reference_point.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "base/cancel.h"
#include "shadow/light_guard.h"
#include "shadow/light_rays.h"

namespace penumbra::report {
namespace {

/// How the variance of a mean falls when the points are doubled.
const double fall = std::exp2(-1.5);

/// Of the sets' counts of visible points.
struct Counts {
  int visible[ReferencePoints::sets] = {};
  int points = 0;  ///< of each

  int sum() const { return std::accumulate(std::begin(visible), std::end(visible), 0); }
  int all() const { return points * ReferencePoints::sets; }
  bool agree() const { return sum() == 0 || sum() == all(); }
  double mean() const { return static_cast<double>(sum()) / all(); }
  double variance_of_mean() const {
    double square = 0;
    for (const int v : visible) {
      const double off = static_cast<double>(v) / points - mean();
      square += off * off;
    }
    return square / ((ReferencePoints::sets - 1) * ReferencePoints::sets);
  }
};

}  // namespace

ReferencePoints::ReferencePoints(const World& world, float target, std::uint32_t seed)
    : world_(world), lights_(world.scene()), target_(target) {
  samples_.reserve(sets);
  for (std::uint64_t k = 0; k < sets; ++k)
    samples_.emplace_back(most_points, static_cast<std::uint32_t>(hash(seed, k)));
}

PointReference ReferencePoints::at(const Receiver& receiver, std::size_t light,
                                   std::uint64_t stream, int least, ShadowCounts& counts) const {
  std::uint8_t bits[most_points / 8];
  if (is_point(lights_.light(light))) {
    const LightRays ray(world_, lights_, receiver, light, samples_[0].pattern(0));
    const int visible = ray.trace(ray.table_x(), ray.table_y(), 1, nullptr, bits, counts);
    return {static_cast<float>(visible), 0, 1};
  }
  const LightGuard guard = guard_light(world_, lights_, receiver, light, counts);
  if (guard == LightGuard::seen) return {};
  Counts found;
  double expected = 0;  // variance, by fewer points
  for (int n = first_points;; n *= 2) {
    throw_if_cancelled();
    for (int k = 0; k < sets; ++k) {
      const SamplePattern pattern =
          samples_[static_cast<std::size_t>(k)].pattern(hash(stream, light));
      const LightRays rays(world_, lights_, receiver, light, pattern,
                           guard == LightGuard::unoccluded);
      found.visible[k] += rays.trace(rays.table_x() + found.points, rays.table_y() + found.points,
                                     n - found.points, nullptr, bits, counts);
    }
    found.points = n;
    const double seen = found.variance_of_mean();
    const double variance = n == first_points ? seen : std::max(expected, (seen + expected) / 2);
    expected = fall * variance;
    // Where all points agree half the share of one of them is in doubt.
    const double doubt = 0.5 / found.all();
    const double error = std::max(std::sqrt(variance), doubt);
    const bool enough = found.agree() ? n >= least : n > first_points;
    if ((enough && error < target_) || n == most_points)
      return {static_cast<float>(found.mean()), static_cast<float>(error),
              static_cast<std::uint32_t>(found.all())};
  }
}

}  // namespace penumbra::report
