#include <gtest/gtest.h>

#include "bake/baked_irradiance.h"
#include "bake/charts.h"
#include "bake/driver.h"
#include "render/direct_light.h"
#include "render/small_scenes.h"

namespace penumbra::bake {
namespace {

class ClosedForm : public ::testing::TestWithParam<BakeDevice> {
 protected:
  void SetUp() override { skip_without_driver(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Devices, ClosedForm,
                         ::testing::Values(BakeDevice::cpu, BakeDevice::gl, BakeDevice::rays));

Light light_of(LightType type) {
  Light light;
  light.type = type;
  light.position = {0.3f, 2.2f, -0.2f};
  light.normal = {0, -1, 0};
  light.edge_u = {0.7f, 0, 0}, light.edge_v = {0, 0, 0.5f};
  if (type == LightType::segment) light.edge_u = {0.6f, 0.2f, 0};
  light.radius = type == LightType::segment ? 0.01f : 0.3f;
  light.direction = normalize(Vec3{-0.3f, -0.9f, 0.1f});
  light.angular_diameter = 0.1f;
  light.emission = {2, 3, 5};
  return light;
}

TEST_P(ClosedForm, IsMetWithoutOccluders) {
  for (const LightType type : {LightType::rect, LightType::sphere, LightType::disk, LightType::sun,
                               LightType::point, LightType::segment}) {
    Scene scene;
    add_floor(scene, add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f})));
    scene.lights.push_back(light_of(type));
    const World world(scene, {.cone_tree = false});
    BakeOptions options;
    options.device = GetParam();
    options.light_samples = 256;
    const BakedIrradiance baked(world, options);
    const PlanarChart chart = chart_of_quad(scene, 0, 70, 33);
    std::vector<Vec3> found(70 * 33);
    baked.of_chart(chart, found);
    const LightViews views(scene);
    const DirectLight direct(views);
    for (int j = 0; j < 33; ++j)
      for (int i = 0; i < 70; ++i) {
        const Vec3 p = chart.texel(static_cast<float>(i), static_cast<float>(j));
        const float expected = direct.irradiance(0, p, chart.normal, Horizon::exact);
        const Vec3& e = found[j * 70 + i];
        ASSERT_NEAR(e.x, 2 * expected, 0.005 * 2 * expected + 1e-7)
            << to_string(type) << " " << i << " " << j;
        ASSERT_NEAR(e.z, 5 * expected, 0.005 * 5 * expected + 1e-7);
      }
  }
}

TEST_P(ClosedForm, StaysFiniteWhereALightTouchesTheReceiver) {
  for (const LightType type : {LightType::rect, LightType::sphere, LightType::disk,
                               LightType::segment, LightType::point}) {
    Scene scene;
    add_floor(scene, add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f})));
    Light light = light_of(type);
    light.position.y = 0;
    light.normal = {1, 0, 0}, light.edge_v = {0, 0.5f, 0};
    light.edge_u = {0, type == LightType::segment ? 0.2f : 0.0f, 0.7f};
    light.emission = Vec3(1);
    scene.lights.push_back(light);
    const World world(scene, {.cone_tree = false});
    BakeOptions options;
    options.device = GetParam();
    const BakedIrradiance baked(world, options);
    std::vector<Vec3> found(80 * 80);
    baked.of_chart(chart_of_quad(scene, 0, 80, 80), found);
    float most = 0;
    for (const Vec3& e : found) {
      ASSERT_TRUE(std::isfinite(e.x) && e.x >= 0) << to_string(type);
      most = std::max(most, e.x);
    }
    if (type != LightType::point) {
      EXPECT_GT(most, 0) << to_string(type);
      EXPECT_LE(most, 3.3f) << to_string(type);
    }
  }
}

}  // namespace
}  // namespace penumbra::bake
