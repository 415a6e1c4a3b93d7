#include "report/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace penumbra::report {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool takes_samples(ShadowKind kind) {
  return kind == ShadowKind::area || kind == ShadowKind::heckbert_herf;
}

/// A scene and its truth.
struct Truth {
  Scene scene;
  World world;
  Reference reference;

  Truth(Scene changed, const RenderOptions& options)
      : scene(std::move(changed)), world(scene, {.cone_tree = scene.sdfs.empty()}) {
    ReferenceOptions size;
    size.width = options.width, size.height = options.height, size.camera = options.camera;
    size.seed = options.seed;
    reference = empty_reference(size, scene.lights.size());
    Progress silent;
    complete_reference(
        world, size, reference, [](const Reference&) {}, silent);
  }
  Truth(const Truth&) = delete;
  Truth& operator=(const Truth&) = delete;
};

void add(const Truth& truth, const RenderOptions& options, const MakeDrawer& make, int repeats,
         SweepMethod& method) {
  MeasureOptions asked;
  asked.picture = options;
  asked.want_picture = false;
  asked.repeats = repeats;
  double rmse = nan, penumbra = nan, seconds = nan;
  try {
    const Measured found = measure(truth.scene, make, truth.reference, asked);
    rmse = found.errors.all.rmse, penumbra = found.errors.all.penumbra_rmse;
    seconds = found.cost.seconds.median;
  } catch (const Error&) {
    // The table of methods says why.
  }
  method.rmse.push_back(rmse);
  method.penumbra_rmse.push_back(penumbra);
  method.seconds.push_back(seconds);
}

}  // namespace

const char* to_string(SweepParameter parameter) {
  constexpr const char* names[] = {"light-size", "distance", "samples"};
  return names[static_cast<int>(parameter)];
}

std::vector<double> log_spaced(double first, double last, int count) {
  std::vector<double> values{first};
  for (int i = 1; i + 1 < count; ++i)
    values.push_back(first * std::pow(last / first, i / (count - 1.0)));
  if (count > 1) values.push_back(last);
  return values;
}

void move_lights(Scene& scene, const Vec3& centre, float factor) {
  for (Light& light : scene.lights)
    if (light.type != LightType::sun && light.type != LightType::mesh)
      light.position = centre + (light.position - centre) * factor;
}

void shrink(RenderOptions& options, int width) {
  if (options.width <= width) return;
  const double scale = static_cast<double>(width) / options.width;
  options.height = std::max(1, static_cast<int>(std::lround(options.height * scale)));
  options.width = width;
}

Sweep sweep(const Scene& scene, const ChangeLights& change, const SweepRequest& request,
            const std::vector<SweepMethodCall>& methods, const MakeDrawer& make, int repeats,
            Progress& progress) {
  const bool by_samples = request.parameter == SweepParameter::samples;
  Sweep out{request.parameter, request.values, {}};
  std::vector<SweepMethodCall> taken;
  for (const SweepMethodCall& m : methods)
    if (!by_samples || takes_samples(m.options.shadows.kind)) taken.push_back(m);
  if (taken.empty()) return out;
  for (SweepMethodCall& m : taken) {
    shrink(m.options, sweep_width);
    out.methods.push_back({m.name, {}, {}, {}});
  }
  progress.start(std::string("sweep of ") + to_string(request.parameter), request.values.size());
  std::unique_ptr<const Truth> truth;
  for (const double value : request.values) {
    if (!by_samples || !truth)
      truth = std::make_unique<Truth>(by_samples ? scene : change(request.parameter, value),
                                      taken.front().options);
    for (std::size_t i = 0; i < taken.size(); ++i) {
      RenderOptions options = taken[i].options;
      if (by_samples) {
        options.shadows.light_samples = static_cast<int>(std::lround(value));
        options.shadows.error.reset();
      }
      add(*truth, options, make, repeats, out.methods[i]);
    }
    progress.advance(1);
  }
  progress.finish();
  return out;
}

}  // namespace penumbra::report
