#include "report/area_curve.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "base/parallel.h"

namespace penumbra::report {
namespace {

constexpr std::array counts{1, 4, 16, 64, 256, 1024};
constexpr int most_drawn = 64;
constexpr std::size_t most_places = 4096;

/// Of the line through two points, by logarithms.
double slope_of(double x0, double y0, double x1, double y1) {
  return std::log(y1 / y0) / std::log(x1 / x0);
}

struct Place {
  Receiver receiver;
  std::size_t light = 0, pixel = 0;
  double truth = 0;
};

std::vector<Place> places_of(const World& world, const Reference& reference, int camera) {
  ReferenceOptions size;
  size.width = reference.width, size.height = reference.height, size.camera = camera;
  std::vector<Place> all;
  for (const PixelReceiver& p : receivers_of(world, size))
    for (std::size_t light = 0; light < reference.lights; ++light) {
      const float truth = reference.point(light, p.pixel).fraction;
      if (truth > kDark && truth < kLit) all.push_back({p.receiver, light, p.pixel, truth});
    }
  if (all.size() <= most_places) return all;
  std::vector<Place> some;
  for (std::size_t i = 0; i < most_places; ++i) some.push_back(all[i * all.size() / most_places]);
  return some;
}

double error_of(const World& world, const std::vector<Place>& places, ShadowOptions options,
                int points) {
  options.kind = ShadowKind::area;
  options.light_samples = points;
  options.error.reset();
  const Shadows shadows(world, options);
  std::vector<double> squares(places.size());
  parallel_for(places.size(), [&](std::size_t i) {
    ShadowCounts counts_of_this;
    const Place& p = places[i];
    const double found = shadows.visibility(p.receiver, p.light, p.pixel, counts_of_this).fraction;
    squares[i] = (found - p.truth) * (found - p.truth);
  });
  double sum = 0;
  for (const double s : squares) sum += s;
  return std::sqrt(sum / static_cast<double>(places.size()));
}

double seconds_of(const Scene& scene, const MakeDrawer& make, const RenderOptions& picture,
                  int points) {
  RenderOptions options = picture;
  options.spp = 1;
  options.shadows.kind = ShadowKind::area;
  options.shadows.light_samples = points;
  options.shadows.error.reset();
  Progress silent;
  const auto begin = std::chrono::steady_clock::now();
  make(scene, options)->draw(options, silent);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

std::optional<EqualArea> equal_area(const AreaCurve& curve, double error) {
  const std::size_t n = curve.points.size();
  if (n == 0 || !(error > 0)) return std::nullopt;
  const auto& x = curve.points;
  std::size_t k = 0;
  while (k < n && curve.errors[k] > error) ++k;
  if (k == 0) return EqualArea{static_cast<std::uint64_t>(x[0]), curve.seconds[0]};
  if (n == 1) return std::nullopt;
  const bool beyond = k == n;
  const std::size_t a = beyond ? n - 2 : k - 1, b = a + 1;
  double slope = slope_of(x[a], curve.errors[a], x[b], curve.errors[b]);
  if (beyond) slope = std::clamp(slope, -1.0, -0.5);
  const std::size_t from = beyond ? b : a;
  const double points = x[from] * std::pow(error / curve.errors[from], 1 / slope);
  const double growth = slope_of(x[a], curve.seconds[a], x[b], curve.seconds[b]);
  const double seconds = curve.seconds[from] * std::pow(points / x[from], growth);
  return EqualArea{static_cast<std::uint64_t>(std::ceil(points * (1 - 1e-9))), seconds};
}

AreaCurve measure_area_curve(const Scene& scene, const World& world, const MakeDrawer& make,
                             const Reference& reference, const RenderOptions& picture,
                             std::optional<double> area_seconds) {
  AreaCurve curve;
  const std::vector<Place> places = places_of(world, reference, picture.camera);
  if (places.empty()) return curve;
  for (const int points : counts) {
    curve.points.push_back(points);
    curve.errors.push_back(error_of(world, places, picture.shadows, points));
    double seconds = 0;
    if (points == most_drawn && area_seconds) {
      seconds = *area_seconds;
    } else if (points <= most_drawn) {
      seconds = seconds_of(scene, make, picture, points);
    } else {
      const double last = curve.seconds[3], before = curve.seconds[2];
      seconds = last + (points - 64) * std::max(last - before, 0.0) / 48;
    }
    curve.seconds.push_back(seconds);
  }
  return curve;
}

}  // namespace penumbra::report
