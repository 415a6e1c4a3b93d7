// All methods on one scene, beside the truth.
#pragma once

#include <string>
#include <vector>

#include "report/advice.h"
#include "report/area_curve.h"
#include "report/machine.h"
#include "report/measure.h"
#include "report/methods.h"
#include "report/sweep.h"

namespace penumbra::report {

/// A method as a person asked for it.
struct MethodCall {
  MethodText text;
  RenderOptions options;                 ///< its shadows are the method's
  std::string command;                   ///< that renders its picture
  std::vector<std::string> conversions;  ///< of the scene, for this method
};

struct MethodResult {
  MethodCall call;
  std::string reason;  ///< why it could not run; empty if it did
  Measured measured;   ///< these four mean nothing if it did not run
  double flip = 0;
  std::optional<double> ssim;  ///< none for tiny pictures
  std::optional<EqualArea> equal_area;

  bool ok() const { return reason.empty(); }
};

struct Comparison {
  std::string scene_file, camera, command;
  std::uint64_t checksum = 0;
  std::vector<Light> lights;
  std::size_t objects = 0;
  std::uint64_t triangles = 0;
  Machine machine;
  Versions versions;
  Reference reference;
  ReferenceOptions reference_options;
  bool reference_was_cached = false;
  float exposure_ev = 0;
  std::vector<MethodResult> methods;
  std::vector<Sweep> sweeps;
  Advice advice;
};

/// How far from the truth a method may be to be advised, where a person does not say.
inline constexpr double default_limit = 0.05;

/// Fills in methods, from `calls` in their order, and advice; all else is there. `world` is that of
/// the reference. `repeats`: of each timed picture; none: three, but no more than five seconds of
/// them. One thing is measured at a time. Throws Cancelled, and what is no Error.
void compare_methods(const Scene& scene, const World& world, const std::vector<MethodCall>& calls,
                     const MakeDrawer& make, std::optional<int> repeats, double limit,
                     Comparison& comparison, Progress& progress);

/// What of each was measured, for advise(): `area` with as many points as the limit takes.
std::vector<Candidate> candidates_of(const std::vector<MethodResult>& methods,
                                     const AreaCurve& curve, double limit);

/// The name of light `index` for people: its own, or type and number.
std::string light_name(const Light& light, std::size_t index);

}  // namespace penumbra::report
