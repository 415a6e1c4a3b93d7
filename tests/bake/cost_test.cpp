// Which way a chart is lit by --device auto.
#include "bake/cost.h"

#include <gtest/gtest.h>

#include "bake/charts.h"
#include "render/small_scenes.h"

namespace penumbra::bake {
namespace {

class CostTest : public ::testing::Test {
 protected:
  CostTest() {
    const auto grey = add_material(scene_, diffuse_material({0.8f, 0.8f, 0.8f}));
    add_floor(scene_, grey);
    for (int i = 0; i < 400; ++i) {
      const float x = 0.4f * static_cast<float>(i % 20) - 4;
      const float z = 0.4f * static_cast<float>(i / 20) - 4;
      add_quad(scene_, {x, 1, z}, {0.2f, 0, 0}, {0, 0, 0.2f}, grey);
    }
  }

  Way way(int side, std::size_t samples, bool has_gl, std::size_t threads = 2) const {
    const Occluders occluders(scene_);
    const PlanarChart chart = chart_of_quad(scene_, 0, side, side);
    const SampledLight light = light_of(samples);
    return cheapest_way(occluders, Tile(chart, 0, 0, side, side), std::span(&light, 1), has_gl,
                        threads);
  }

  static SampledLight light_of(std::size_t samples) {
    SampledLight light;
    for (std::size_t i = 0; i < samples; ++i)
      light.samples.push_back({{static_cast<float>(i) / static_cast<float>(samples), 4, 0},
                               {0, -1, 0},
                               1.0f / static_cast<float>(samples)});
    return light;
  }

  Scene scene_;
};

TEST_F(CostTest, AGraphicsProcessorGetsLargeChartsOfManySamples) {
  EXPECT_EQ(way(1024, 1024, true), Way::gl);
  EXPECT_EQ(way(1024, 1024, false), Way::raster);
}

TEST_F(CostTest, SmallChartsAndFewSamplesStayOnTheProcessor) {
  EXPECT_NE(way(16, 16, true), Way::gl);
  EXPECT_NE(way(128, 4, true), Way::gl);
  EXPECT_EQ(way(4, 4, true), Way::rays);
}

TEST_F(CostTest, ManyThreadsNeedNoGraphicsProcessor) {
  EXPECT_EQ(way(256, 64, true, 1), Way::gl);
  EXPECT_NE(way(256, 64, true, 64), Way::gl);
}

TEST_F(CostTest, OpenGlCostsMoreForMoreOfEverything) {
  const Occluders occluders(scene_);
  const auto cost = [&](int side, std::size_t samples, std::size_t threads) {
    const PlanarChart chart = chart_of_quad(scene_, 0, side, side);
    return gl_cost(occluders, Tile(chart, 0, 0, side, side), light_of(samples), threads);
  };
  const float base = cost(256, 256, 2);
  EXPECT_GT(base, 0);
  EXPECT_GT(cost(512, 256, 2), base);
  EXPECT_GT(cost(256, 512, 2), base);
  EXPECT_GT(cost(256, 256, 4), base);
  EXPECT_EQ(cost(256, 0, 2), 0);
}

}  // namespace
}  // namespace penumbra::bake
