// Charts lit in passes of more and more points on each light, so that the work can end early.
#pragma once

#include <chrono>
#include <functional>
#include <optional>

#include "bake/baked_irradiance.h"
#include "bake/light_chart.h"
#include "bake/plan.h"
#include "base/progress.h"

namespace penumbra::bake {

struct PassOptions {
  float error = 0;  ///< of a chart's brightest irradiance; 0: all points are taken
  std::optional<std::chrono::steady_clock::time_point> deadline;
  std::vector<std::size_t> only;  ///< of the plan's charts, these alone; empty: all
  /// Asked when the work is cancelled. True: it ends as at a deadline, and cancel_requested is
  /// false again. Null: never.
  std::function<bool()> finish_early = {};
};

struct LitCharts {
  std::vector<LitChart> charts;  ///< in the order of the plan; empty where not asked for
  double points = 0;             ///< a light, on average over texels and extended lights
};

/// Lights the plan's charts: all with one point a light, then all with 4, then afresh with 16, 64 …
/// up to the number that the samples' options ask for. Each pass is two sets of points, jittered
/// independently, and the irradiance is the mean of all, weighted by their numbers.
///
/// `error`: a chart is done, at 16 points or later, when the standard error of its irradiance is at
/// most `error` times its brightest one: half the root mean square, over the texels on the surface,
/// of the difference between the means of the two halves, each in the channel where it is largest.
///
/// `deadline`: the first pass is finished in any case, a pass that would end after it has fewer
/// points. Without one the result depends on the arguments alone.
LitCharts light_in_passes(const Plan& plan, const BakedIrradiance& irradiance,
                          const SurfaceLight& surface, const LightOptions& light,
                          const PassOptions& options, Progress& progress);

}  // namespace penumbra::bake
