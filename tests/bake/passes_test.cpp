#include "bake/passes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>

#include "bake/bake_scenes.h"
#include "base/cancel.h"
#include "base/error.h"
#include "base/parallel.h"
#include "render/direct_light.h"

namespace penumbra::bake {
namespace {

using Clock = std::chrono::steady_clock;

/// A floor under a rectangle that emits, with or without a plate between.
class PassesTest : public ::testing::Test {
 protected:
  PassesTest() {
    test::add_quad(scene_, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
    Light light;
    light.type = LightType::rect;
    light.position = {0, 2, 0};
    light.normal = {0, -1, 0};
    light.edge_u = {1, 0, 0}, light.edge_v = {0, 0, 1};
    light.emission = {4, 2, 1};
    scene_.lights.push_back(light);
    samples_.light_samples = 256;
    textures_.texel_size = 0.05f;
    light_.quantity = Quantity::irradiance;
  }

  void add_plate() {
    const std::uint32_t plate = test::add_quad(scene_, {-0.5f, 0.8f, 0.5f}, {1, 0, 0}, {0, 0, -1});
    scene_.objects[plate].receives = false;
  }

  LitCharts lit(const PassOptions& options) {
    const Plan plan = make_plan(scene_, textures_);
    const World world(scene_, {.cone_tree = false});
    const BakedIrradiance irradiance(world, samples_);
    const MaterialLookup materials(scene_);
    Progress silent;
    return light_in_passes(plan, irradiance, {scene_, materials, {}}, light_, options, silent);
  }

  /// All points at once, `count` of them.
  std::vector<Vec3> truth(int count) {
    const Plan plan = make_plan(scene_, textures_);
    const World world(scene_, {.cone_tree = false});
    BakeOptions options = samples_;
    options.light_samples = count;
    options.seed = 77;
    const MaterialLookup materials(scene_);
    return light_chart(plan.charts.at(0), *plan.meshes[0], BakedIrradiance(world, options),
                       {scene_, materials, {}}, light_)
        .texels.value;
  }

  static PassOptions until(Clock::time_point deadline) {
    PassOptions options;
    options.deadline = deadline;
    return options;
  }

  Scene scene_;
  BakeOptions samples_;
  TextureOptions textures_;
  LightOptions light_;
};

/// Root mean square difference in red over the brightest red.
double difference(const std::vector<Vec3>& found, const std::vector<Vec3>& truth) {
  double sum = 0;
  float brightest = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const auto gap = static_cast<double>(found[i].x - truth[i].x);
    sum += gap * gap;
    brightest = std::max(brightest, truth[i].x);
  }
  return std::sqrt(sum / static_cast<double>(truth.size())) / static_cast<double>(brightest);
}

double mean(const std::vector<Vec3>& values) {
  double sum = 0;
  for (const Vec3& v : values) sum += static_cast<double>(v.x);
  return sum / static_cast<double>(values.size());
}

TEST_F(PassesTest, AllOfThemGiveTheClosedForm) {
  const LitCharts found = lit({});
  EXPECT_NEAR(found.points, 256, 4);
  const Plan plan = make_plan(scene_, textures_);
  const PlanarChart& shape = plan.charts.at(0).shape;
  const LightViews views(scene_);
  const DirectLight direct(views);
  for (int j = 0; j < shape.height; ++j)
    for (int i = 0; i < shape.width; ++i) {
      const Vec3 p = shape.texel(static_cast<float>(i), static_cast<float>(j));
      const float expected = 4 * direct.irradiance(0, p, shape.normal, Horizon::exact);
      ASSERT_NEAR(found.charts[0].texels.value[static_cast<std::size_t>(j * shape.width + i)].x,
                  expected, 0.01f * expected);
    }
}

TEST_F(PassesTest, AreTheTrueMeanAtAnyNumberOfPoints) {
  add_plate();
  const std::vector<Vec3> expected = truth(4096);
  double before = std::numeric_limits<double>::infinity();
  for (const int count : {4, 16, 64, 256}) {
    samples_.light_samples = count;
    const LitCharts found = lit({});
    EXPECT_NEAR(found.points, count, 2);
    const double gap = difference(found.charts[0].texels.value, expected);
    EXPECT_LT(gap, 0.6 * before) << count;
    EXPECT_NEAR(mean(found.charts[0].texels.value), mean(expected), 0.1 / std::sqrt(count));
    before = gap;
  }
  EXPECT_LT(before, 0.01);
}

TEST_F(PassesTest, ADeadlineThatIsOverLeavesTheFirst) {
  add_plate();
  test::add_quad(scene_, {-2, 0, -2}, {4, 0, 0}, {0, 2, 0});
  const LitCharts found = lit(until(Clock::now()));
  ASSERT_EQ(found.charts.size(), 2u);
  EXPECT_EQ(found.points, 1);
  for (const LitChart& chart : found.charts) {
    ASSERT_TRUE(chart.has_texels());
    EXPECT_GT(mean(chart.texels.value), 0);
  }
  const double expected = mean(truth(1024));
  EXPECT_NEAR(mean(found.charts[0].texels.value), expected, 0.3 * expected);
}

TEST_F(PassesTest, ADeadlineIsKeptAndItsTimeUsed) {
  add_plate();
  textures_.texel_size = 0.01f;
  samples_.light_samples = 65536;
  const Clock::time_point begin = Clock::now();
  const LitCharts found = lit(until(begin + std::chrono::milliseconds(400)));
  const std::chrono::duration<double> taken = Clock::now() - begin;
  EXPECT_LT(taken.count(), 3);
  EXPECT_GT(found.points, 16);
  EXPECT_LT(found.points, 65536 / 2);
}

TEST_F(PassesTest, AnErrorThatIsReachedEndsThem) {
  add_plate();
  samples_.light_samples = 4096;
  const std::vector<Vec3> expected = truth(16384);
  PassOptions options;
  double before = 0;
  for (const float error : {0.02f, 0.004f}) {
    options.error = error;
    const LitCharts found = lit(options);
    EXPECT_GE(found.points, 16);
    EXPECT_LT(found.points, 2048);
    EXPECT_GT(found.points, before);
    EXPECT_LT(difference(found.charts[0].texels.value, expected), 1.5 * error);
    before = found.points;
  }
}

TEST_F(PassesTest, EachChartEndsByItself) {
  PassOptions options;
  options.error = 0.005f;
  samples_.light_samples = 1024;
  add_plate();
  const double shadowed = lit(options).points;
  test::add_quad(scene_, {-2, 0, -2}, {4, 0, 0}, {0, 4, 0});  // sees no shadow
  const double both = lit(options).points;
  EXPECT_LT(both, shadowed);
  EXPECT_GT(both, shadowed / 2);
}

TEST_F(PassesTest, DependOnNoThread) {
  add_plate();
  PassOptions options;
  options.error = 0.01f;
  const std::vector<Vec3> all = lit(options).charts[0].texels.value;
  const ThreadLimit one(1);
  EXPECT_EQ(lit(options).charts[0].texels.value, all);
}

TEST_F(PassesTest, NeedMoreMemory) {
  textures_.texel_size = 0.005f;
  textures_.most_bytes = 100'000'000;
  EXPECT_NO_THROW(make_plan(scene_, textures_));
  textures_.in_passes = true;
  EXPECT_ANY_THROW(make_plan(scene_, textures_));
}

/// Asks to stop after some progress, as Ctrl-C does.
class Interrupting final : public Progress {
 public:
  explicit Interrupting(int calls) : left_(calls) {}
  void advance(std::uint64_t) override {
    if (--left_ == 0) cancel_requested = true;
  }

 private:
  std::atomic<int> left_;
};

TEST_F(PassesTest, AnInterruptLeavesTheTrueMeanSoFar) {
  add_plate();
  test::add_quad(scene_, {-2, 0, -2}, {4, 0, 0}, {0, 2, 0});
  const Plan plan = make_plan(scene_, textures_);
  const World world(scene_, {.cone_tree = false});
  const BakedIrradiance irradiance(world, samples_);
  const MaterialLookup materials(scene_);
  const double expected = mean(truth(1024));
  PassOptions options;
  options.finish_early = [] { return cancel_requested.exchange(false); };
  for (const int calls : {1, 2, 3, 4, 5, 6, 7, 8}) {
    Interrupting progress(calls);
    const LitCharts found =
        light_in_passes(plan, irradiance, {scene_, materials, {}}, light_, options, progress);
    EXPECT_FALSE(cancel_requested);
    EXPECT_LT(found.points, 250) << calls;
    EXPECT_GE(found.points, 1) << calls;
    for (const LitChart& chart : found.charts) ASSERT_TRUE(chart.has_texels());
    EXPECT_NEAR(mean(found.charts[0].texels.value), expected, 0.3 * expected) << calls;
  }
  options.finish_early = nullptr;
  Interrupting progress(2);
  EXPECT_THROW(
      light_in_passes(plan, irradiance, {scene_, materials, {}}, light_, options, progress),
      Cancelled);
  cancel_requested = false;
}

}  // namespace
}  // namespace penumbra::bake
