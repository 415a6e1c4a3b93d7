#include "report/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "compare/flip.h"
#include "compare/picture_errors.h"

namespace penumbra::report {
namespace {

/// Light on its way to a screen.
Image shown(const Image& color, float exposure_ev) {
  Image out = color;
  const float scale = std::exp2(exposure_ev);
  for (float& value : out.data) value = std::clamp(value * scale, 0.0f, 1.0f);
  return out;
}

void compare_pictures(const Image& truth, const Image& found, MethodResult& result) {
  result.flip = mean_value(flip_map(truth, found));
  result.ssim = picture_errors(truth, found, PictureKind::display).ssim;
}

bool is_plain_area(const MethodResult& result) {
  const ShadowOptions& o = result.call.options.shadows;
  return result.ok() && o.kind == ShadowKind::area && !o.error &&
         (o.light_samples == 0 || o.light_samples == 64);
}

std::optional<double> seconds_of_area(const std::vector<MethodResult>& methods) {
  for (const MethodResult& m : methods)
    if (is_plain_area(m)) return m.measured.cost.seconds.median;
  return std::nullopt;
}

MethodResult run(const Scene& scene, const MethodCall& call, const MakeDrawer& make,
                 const MeasureOptions& options, const Image& truth, float exposure_ev,
                 const Reference& reference) {
  MethodResult result;
  result.call = call;
  try {
    MeasureOptions own = options;
    own.picture = call.options;
    own.picture.exposure_ev = exposure_ev;
    result.measured = measure(scene, make, reference, own);
    compare_pictures(truth, shown(result.measured.picture.color, exposure_ev), result);
  } catch (const Error& error) {
    result.reason = error.what();
  }
  return result;
}

}  // namespace

std::string light_name(const Light& light, std::size_t index) {
  return light.name.empty() ? fmt::format("{} {}", to_string(light.type), index) : light.name;
}

std::vector<Candidate> candidates_of(const std::vector<MethodResult>& methods,
                                     const AreaCurve& curve, double limit) {
  std::vector<Candidate> out;
  for (const MethodResult& m : methods) {
    if (!m.ok()) continue;
    const Candidate as_it_is{std::string(m.call.text.name),
                             m.measured.errors.all.penumbra_rmse,
                             m.measured.cost.seconds.median,
                             {}};
    out.push_back(as_it_is);
    if (m.call.text.kind != ShadowKind::area) continue;
    if (const auto enough = equal_area(curve, limit); enough && enough->points < (1 << 20))
      out.back() = {as_it_is.name, limit, enough->seconds, static_cast<int>(enough->points)};
  }
  return out;
}

void compare_methods(const Scene& scene, const World& world, const std::vector<MethodCall>& calls,
                     const MakeDrawer& make, std::optional<int> repeats, double limit,
                     Comparison& comparison, Progress& progress) {
  MeasureOptions options;
  if (repeats) options.repeats = *repeats, options.enough = INFINITY;
  const Image truth = shown(comparison.reference.color, comparison.exposure_ev);
  for (const MethodCall& call : calls) {
    progress.start(call.text.name, 0);
    comparison.methods.push_back(
        run(scene, call, make, options, truth, comparison.exposure_ev, comparison.reference));
    progress.finish();
  }
  progress.start("equal area", 0);
  RenderOptions picture = calls.front().options;
  picture.exposure_ev = comparison.exposure_ev;
  AreaCurve curve;
  try {
    curve = measure_area_curve(scene, world, make, comparison.reference, picture,
                               seconds_of_area(comparison.methods));
  } catch (const Error&) {
    // Nor can the device draw area lights: there is nothing to exchange for.
  }
  for (MethodResult& m : comparison.methods)
    if (m.ok()) m.equal_area = equal_area(curve, m.measured.errors.all.penumbra_rmse);
  progress.finish();
  const bool has_penumbra = std::ranges::any_of(comparison.methods, [](const MethodResult& m) {
    return m.measured.errors.all.penumbra_points > 0;
  });
  comparison.advice = advise(candidates_of(comparison.methods, curve, limit), limit, has_penumbra);
}

}  // namespace penumbra::report
