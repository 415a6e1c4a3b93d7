#include "report/measure.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "report/process_memory.h"

namespace penumbra::report {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// The pixel's centre, without layers.
RenderOptions bare(const RenderOptions& picture) {
  RenderOptions o = picture;
  o.spp = 1;
  o.want_visibility = o.want_depth = o.want_normal = o.want_error = o.want_steps = false;
  return o;
}

Fractions masked(RenderResult& result) {
  for (Image& image : result.visibility)
    for (std::size_t i = 0; i < image.data.size(); ++i)
      if (!std::isfinite(result.depth.data[i]))
        image.data[i] = std::numeric_limits<float>::quiet_NaN();
  return std::move(result.visibility);
}

struct Lap {
  double build = 0, render = 0;
  double both() const { return build + render; }
};

/// One build and one picture.
struct Drawn {
  std::unique_ptr<Drawer> drawer;
  RenderResult result;
  Lap lap;
};

Drawn draw_once(const Scene& scene, const MakeDrawer& make, const RenderOptions& options) {
  Progress silent;
  Drawn drawn;
  const auto begin = Clock::now();
  drawn.drawer = make(scene, options);
  drawn.lap.build = seconds_since(begin);
  const auto middle = Clock::now();
  drawn.result = drawn.drawer->draw(options, silent);
  drawn.lap.render = seconds_since(middle);
  return drawn;
}

void set_seconds(const std::vector<Lap>& laps, Cost& cost) {
  std::vector<double> build, render, both;
  for (const Lap& lap : laps)
    build.push_back(lap.build), render.push_back(lap.render), both.push_back(lap.both());
  const auto [least, most] = std::minmax_element(both.begin(), both.end());
  cost.seconds = {median(both), *least, *most, static_cast<int>(laps.size())};
  cost.build = median(build), cost.render = median(render);
}

void set_counts(const Scene& scene, const RenderOptions& options, const Drawn& drawn, Cost& cost) {
  const RenderStats& stats = drawn.result.stats;
  cost.rays = stats.shadows.rays;
  cost.texel_samples = drawn.drawer->texel_samples();
  if (!stats.device.empty())
    cost.evaluations = stats.field_steps;
  else if (options.shadows.marches_field())
    cost.evaluations = stats.shadows.march_steps;
  else if (scene.sdfs.empty())
    cost.evaluations = 0;
}

}  // namespace

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Fractions fractions_of(const Reference& reference) {
  Fractions out(reference.lights, Image(reference.width, reference.height, 1));
  for (std::size_t light = 0; light < reference.lights; ++light)
    for (std::size_t i = 0; i < reference.pixels(); ++i)
      out[light].data[i] = reference.surface[i] ? reference.point(light, i).fraction
                                                : std::numeric_limits<float>::quiet_NaN();
  return out;
}

Errors errors_of(const Fractions& fractions, const Reference& reference) {
  const Fractions truth = fractions_of(reference);
  Errors errors;
  std::vector<float> all_truth, all_found;
  for (std::size_t light = 0; light < reference.lights; ++light) {
    const std::vector<float>&a = truth[light].data, &b = fractions[light].data;
    errors.lights.push_back(field_errors(a, b));
    all_truth.insert(all_truth.end(), a.begin(), a.end());
    all_found.insert(all_found.end(), b.begin(), b.end());
  }
  errors.all = field_errors(all_truth, all_found);
  return errors;
}

Measured measure(const Scene& scene, const MakeDrawer& make, const Reference& reference,
                 const MeasureOptions& options) {
  Measured out;
  const PeakMemory memory;
  RenderOptions centres = bare(options.picture);
  centres.want_visibility = centres.want_depth = true;
  Drawn drawn = draw_once(scene, make, centres);
  const Lap warm_up = drawn.lap;
  out.fractions = masked(drawn.result);
  out.errors = errors_of(out.fractions, reference);
  if (!drawn.result.stats.device.empty()) out.device = drawn.result.stats.device;
  std::vector<Lap> laps;
  double spent = 0;
  // What takes so long needs no warming up, and layers cost it nothing that shows, unless visible
  // fractions are textures of their own.
  if (warm_up.both() > options.enough && !drawn.drawer->texel_samples())
    laps.push_back(warm_up), spent = warm_up.both();
  const RenderOptions timed = bare(options.picture);
  set_counts(scene, timed, drawn, out.cost);
  for (int i = 0; i < options.repeats && spent < options.enough; ++i) {
    drawn = {};
    drawn = draw_once(scene, make, timed);
    set_counts(scene, timed, drawn, out.cost);
    laps.push_back(drawn.lap);
    spent += drawn.lap.both();
  }
  set_seconds(laps, out.cost);
  if (options.want_picture) {
    Progress silent;
    RenderOptions picture = options.picture;
    const auto begin = Clock::now();
    out.picture = drawn.drawer->draw(picture, silent);
    out.cost.picture = seconds_since(begin);
  }
  out.cost.peak_bytes = memory.bytes();
  return out;
}

}  // namespace penumbra::report
