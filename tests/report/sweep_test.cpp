#include "report/sweep.h"

#include <gtest/gtest.h>

namespace penumbra::report {
namespace {

TEST(Sweep, ValuesAreSpacedByTheirLogarithms) {
  const auto values = log_spaced(0.01, 1, 3);
  ASSERT_EQ(values.size(), 3u);
  EXPECT_EQ(values[0], 0.01);
  EXPECT_NEAR(values[1], 0.1, 1e-12);
  EXPECT_EQ(values[2], 1);
  EXPECT_EQ(log_spaced(1, 64, 2), (std::vector<double>{1, 64}));
}

TEST(Sweep, LightsMoveAboutTheCentreAndSunsStay) {
  Scene scene;
  Light light;
  light.type = LightType::sphere;
  light.position = {3, 4, 0};
  scene.lights.push_back(light);
  light.type = LightType::sun;
  scene.lights.push_back(light);
  move_lights(scene, {1, 0, 0}, 2);
  EXPECT_EQ(scene.lights[0].position, Vec3(5, 8, 0));
  EXPECT_EQ(scene.lights[1].position, Vec3(3, 4, 0));
}

TEST(Sweep, PicturesKeepTheirShape) {
  RenderOptions options;
  options.width = 960, options.height = 540;
  shrink(options, 192);
  EXPECT_EQ(options.width, 192);
  EXPECT_EQ(options.height, 108);
  shrink(options, 500);
  EXPECT_EQ(options.width, 192);
  options.width = 5000, options.height = 1;
  shrink(options, 192);
  EXPECT_EQ(options.height, 1);
}

}  // namespace
}  // namespace penumbra::report
