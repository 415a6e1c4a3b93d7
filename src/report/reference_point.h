// The visible fraction of a light from one point, as exactly as it is asked for, and how exactly
// that is.
#pragma once

#include <vector>

#include "shadow/shadows.h"

namespace penumbra::report {

/// Of one light from one point.
struct PointReference {
  float fraction = 1;        ///< visible fraction in [0, 1]
  float standard_error = 0;  ///< estimated
  std::uint32_t points = 0;  ///< rays that it took; 0: proven without
};

/// Eight sets of points of the light, randomised independently (Owen-scrambled Sobol sequences,
/// each turned or shifted for the receiver), are doubled until the standard error of their mean is
/// below the target. It is estimated from how much the eight means differ (randomised quasi-Monte
/// Carlo; Owen 2013, Monte Carlo theory, methods and examples, section 17.3). Eight are few, and to
/// stop when they happen to agree would flatter the estimate. So it is averaged with what the
/// estimate with half the points promised, and never taken for less than that: a variance falls by
/// 2^1.5 for an edge across a square (He and Wang 2015, On the convergence rate of randomized
/// quasi-Monte Carlo for discontinuous functions).
class ReferencePoints {
 public:
  static constexpr int sets = 8;
  static constexpr int first_points = 32;  ///< of each set
  /// Of each set where all agree, but a neighbour sees something else.
  static constexpr int points_at_edges = 256;
  static constexpr int most_points = 8192;  ///< so that 0.002 is reached even if sets were no
                                            ///< better than chance

  /// `target`: standard error, > 0. Keeps a reference to the world, whose cone tree, if there is
  /// one, proves lit points lit without rays. Thread-safe.
  ReferencePoints(const World& world, float target, std::uint32_t seed);

  /// `stream` decorrelates receivers: the same number gives the same answer. `least`: points of
  /// each set before they are believed where all agree. Looks at cancel_requested; throws
  /// Cancelled.
  PointReference at(const Receiver& receiver, std::size_t light, std::uint64_t stream, int least,
                    ShadowCounts& counts) const;

 private:
  const World& world_;
  LightViews lights_;
  float target_;
  std::vector<LightSamples> samples_;  ///< by set
};

}  // namespace penumbra::report
