#include "bake/passes.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "base/error.h"
#include "base/parallel.h"

namespace penumbra::bake {
namespace {

using Clock = std::chrono::steady_clock;

constexpr float growth = 4;
constexpr float afresh = 16;  // points; means of few on a near light lean to one side
constexpr double progress_steps = 256;

/// One set of the samples alone.
class OfSet final : public Irradiance {
 public:
  OfSet(const BakedIrradiance& all, const SampleSet& set) : all_(all), set_(set) {}
  void of_chart(const PlanarChart& chart, std::span<Vec3> out) const override {
    all_.of_chart(chart, set_, out);
  }
  void of_points(std::span<const SurfacePoint> points, std::span<Vec3> out) const override {
    all_.of_points(points, set_, out);
  }
  void of_curved(const PlanarChart& plane, std::span<const SurfacePoint> points,
                 std::span<const std::size_t> texels, std::span<Vec3> out) const override {
    all_.of_curved(plane, points, texels, set_, out);
  }

 private:
  const BakedIrradiance& all_;
  SampleSet set_;
};

/// A chart between passes. Shares are of the points that it would have without passes.
class RefinedChart {
 public:
  RefinedChart(const CutChart& chart, const WorldMesh& mesh, const BakedIrradiance& irradiance,
               int supersample)
      : chart_(chart),
        mesh_(mesh),
        irradiance_(irradiance),
        samples_(samples_of(chart, mesh, supersample)) {
    for (Half& half : halves_) half.sum.resize(samples_.places.size());
    const std::vector<int> counts = irradiance.sample_counts(chart.shape, {});
    most_ = counts.empty() ? 1 : static_cast<float>(*std::ranges::max_element(counts));
    extended_ = std::ranges::count_if(counts, [](int n) { return n > 1; });
  }

  float share() const { return halves_[0].share + halves_[1].share; }
  /// On the light that has most, up to now.
  float points() const { return share() * most_; }
  bool is_finished() const { return share() > 0.9999f; }
  /// On all extended lights together; point lights have one at any time.
  double points_of_all() const { return points_; }
  std::ptrdiff_t extended_lights() const { return extended_; }
  double texels() const {
    return static_cast<double>(samples_.grid.width) * static_cast<double>(samples_.grid.height);
  }
  /// Texels times points of a pass up to `share`.
  double work(float share) const {
    return texels() *
           static_cast<double>((share - (starts_afresh(share) ? 0 : this->share())) * most_);
  }
  /// The share after the next whole pass.
  float next() const {
    float all = 1;  // the least power of four above the points that there are
    while (all * growth < most_ * 0.9999f && all <= points() * 1.0001f) all *= growth;
    return all > points() * 1.0001f ? std::min(all / most_, 1.0f) : 1.0f;
  }

  void refine(float share) {
    bool drops = starts_afresh(share);
    if (this->share() == 0 && share * most_ < 2) return add(halves_[0], share, false);
    for (Half& half : halves_) {
      const float has = drops ? 0 : half.share;
      if (share / 2 > has) add(half, share / 2 - has, drops), drops = false;
    }
  }

  /// Root mean square of the difference of the halves, halved, over the brightest irradiance.
  float error() const {
    double sum = 0, count = 0;
    float brightest = 0;
    for (std::size_t i = 0; i < samples_.places.size(); ++i) {
      if (!samples_.places[i].is_used()) continue;
      const Vec3 a = halves_[0].sum[i] / halves_[0].share, b = halves_[1].sum[i] / halves_[1].share;
      const auto gap = static_cast<double>(max_component(abs(a - b)));
      sum += gap * gap, count += 1;
      brightest = std::max(brightest, max_component(mean(i)));
    }
    return brightest > 0 ? static_cast<float>(std::sqrt(sum / count) / 2) / brightest : 0;
  }
  bool knows_error() const { return points() > afresh * 0.9999f && halves_[1].share > 0; }

  LitChart finish(const SurfaceLight& surface, const LightOptions& options) {
    samples_.values.resize(samples_.places.size());
    for (std::size_t i = 0; i < samples_.values.size(); ++i) samples_.values[i] = mean(i);
    return compose_chart(chart_, mesh_, samples_, surface, options);
  }

 private:
  struct Half {
    std::vector<Vec3> sum;  // of means times shares
    float share = 0;
  };

  bool starts_afresh(float share) const {
    return share * most_ > afresh * 0.9999f && points() < afresh * 0.9999f;
  }

  Vec3 mean(std::size_t i) const { return (halves_[0].sum[i] + halves_[1].sum[i]) / share(); }

  void clear() {
    for (Half& half : halves_) {
      std::ranges::fill(half.sum, Vec3());
      half.share = 0;
    }
    points_ = 0;
  }

  /// Where it is cancelled all stays as it was. `drops`: what there is before.
  void add(Half& half, float share, bool drops) {
    const SampleSet set{share, ++sets_};
    find_irradiance(chart_, mesh_, OfSet(irradiance_, set), samples_);
    if (drops) clear();
    for (std::size_t i = 0; i < half.sum.size(); ++i) half.sum[i] += samples_.values[i] * share;
    half.share += share;
    samples_.values = {};
    const std::vector<int> whole = irradiance_.sample_counts(chart_.shape, {}),
                           counts = irradiance_.sample_counts(chart_.shape, set);
    for (std::size_t l = 0; l < counts.size(); ++l)
      if (whole[l] > 1) points_ += counts[l];
  }

  const CutChart& chart_;
  const WorldMesh& mesh_;
  const BakedIrradiance& irradiance_;
  ChartSamples samples_;
  Half halves_[2];
  float most_ = 1;
  std::ptrdiff_t extended_ = 0;
  double points_ = 0;
  std::uint32_t sets_ = 0;
};

class Passes {
 public:
  Passes(const Plan& plan, const BakedIrradiance& irradiance, const SurfaceLight& surface,
         const LightOptions& light, const PassOptions& options, Progress& progress)
      : plan_(plan),
        irradiance_(irradiance),
        surface_(surface),
        light_(light),
        options_(options),
        progress_(progress),
        charts_(plan.charts.size()) {}

  LitCharts run() {
    const auto total = static_cast<double>(plan_.texel_count()) * progress_steps;
    progress_.start("bake", static_cast<std::uint64_t>(total));
    order_ = largest_first();
    try {
      first_pass();
      while (pass()) {
      }
    } catch (const Cancelled&) {
      if (!options_.finish_early || !options_.finish_early()) throw;
      order_ = largest_first();
      first_pass();
    }
    return finish();
  }

 private:
  std::vector<std::size_t> largest_first() const {
    std::vector<std::size_t> order = options_.only;
    if (order.empty()) {
      order.resize(charts_.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
    }
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) {
      const PlanarChart& shape = plan_.charts[i].shape;
      return static_cast<std::int64_t>(shape.width) * shape.height;
    });
    return order;
  }

  /// Of the charts that have nothing yet.
  void first_pass() {
    const Clock::time_point begin = Clock::now();
    parallel_for(order_.size(), [&](std::size_t k) {
      const CutChart& chart = plan_.charts[order_[k]];
      auto& refined = charts_[order_[k]];
      if (!refined)
        refined.emplace(chart, *plan_.meshes[chart.shape.instance], irradiance_,
                        light_.supersample);
      if (refined->share() == 0) refine(*refined, refined->next());
    });
    double work = 0;
    for (const std::size_t i : order_) work += charts_[i]->texels();
    seconds_per_work_ = since(begin) / std::max(work, 1.0);
  }

  /// False if nothing is left to do, or no time to do it.
  bool pass() {
    std::erase_if(order_, [&](std::size_t i) { return is_done(*charts_[i]); });
    double work = 0;
    for (const std::size_t i : order_) work += charts_[i]->work(charts_[i]->next());
    const float part = part_in_time(work * seconds_per_work_);
    const Clock::time_point begin = Clock::now();
    std::vector<double> done(order_.size());
    parallel_for(order_.size(), [&](std::size_t k) {
      RefinedChart& chart = *charts_[order_[k]];
      const float whole = chart.next();
      float share = whole;
      if (part < 1) share = chart.share() + (whole - chart.share()) * part;
      if (is_late() || (part < 1 && chart.work(share) < 2 * chart.texels())) return;
      done[k] = chart.work(share);
      refine(chart, share);
    });
    const double all = std::accumulate(done.begin(), done.end(), 0.0);
    if (all > 0) seconds_per_work_ = since(begin) / all;
    return all > 0;
  }

  bool is_done(const RefinedChart& chart) const {
    return chart.is_finished() ||
           (options_.error > 0 && chart.knows_error() && chart.error() <= options_.error);
  }

  bool is_late() const { return options_.deadline && Clock::now() >= *options_.deadline; }
  /// Of a pass that takes so long, what fits.
  float part_in_time(double seconds) const {
    if (!options_.deadline) return 1;
    const double left = std::chrono::duration<double>(*options_.deadline - Clock::now()).count();
    return left < seconds ? static_cast<float>(std::max(left, 0.0) / seconds) : 1;
  }
  static double since(const Clock::time_point& begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }

  void refine(RefinedChart& chart, float share) {
    const double before = chart.share();
    chart.refine(share);
    progress_.advance(static_cast<std::uint64_t>((chart.share() - before) * chart.texels() /
                                                 (light_.supersample * light_.supersample) *
                                                 progress_steps));
  }

  LitCharts finish() {
    LitCharts lit;
    double lights = 0;
    for (const auto& chart : charts_) {
      if (!chart) continue;
      lit.points += chart->points_of_all() * chart->texels();
      lights += static_cast<double>(chart->extended_lights()) * chart->texels();
    }
    lit.points = lights > 0 ? lit.points / lights : 1;
    lit.charts.resize(charts_.size());
    parallel_for(charts_.size(), [&](std::size_t i) {
      if (!charts_[i]) return;
      lit.charts[i] = charts_[i]->finish(surface_, light_);
      charts_[i].reset();
    });
    progress_.finish();
    return lit;
  }

  const Plan& plan_;
  const BakedIrradiance& irradiance_;
  const SurfaceLight& surface_;
  const LightOptions& light_;
  const PassOptions& options_;
  Progress& progress_;
  std::vector<std::optional<RefinedChart>> charts_;
  std::vector<std::size_t> order_;  // of those that are not done
  double seconds_per_work_ = 0;
};

}  // namespace

LitCharts light_in_passes(const Plan& plan, const BakedIrradiance& irradiance,
                          const SurfaceLight& surface, const LightOptions& light,
                          const PassOptions& options, Progress& progress) {
  return Passes(plan, irradiance, surface, light, options, progress).run();
}

}  // namespace penumbra::bake
