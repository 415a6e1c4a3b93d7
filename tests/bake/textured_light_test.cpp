// Lights with a texture: the stained glass window (Heckbert and Herf 1997, section 3.7).
#include <gtest/gtest.h>

#include "bake/baked_irradiance.h"
#include "bake/charts.h"
#include "bake/driver.h"
#include "bake/light_sampler.h"
#include "render/direct_light.h"
#include "render/small_scenes.h"
#include "scene/finish.h"

namespace penumbra::bake {
namespace {

class TexturedLight : public ::testing::TestWithParam<BakeDevice> {
 protected:
  void SetUp() override { skip_without_driver(GetParam()); }

  std::vector<Vec3> baked(const Scene& scene, int side, int samples) const {
    const World world(scene, {.cone_tree = false});
    BakeOptions options;
    options.device = GetParam();
    options.light_samples = samples;
    std::vector<Vec3> found(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    BakedIrradiance(world, options).of_chart(chart_of_quad(scene, 0, side, side), found);
    return found;
  }
};
INSTANTIATE_TEST_SUITE_P(Devices, TexturedLight,
                         ::testing::Values(BakeDevice::cpu, BakeDevice::gl, BakeDevice::rays),
                         [](const auto& param) { return name_of(param.param); });

/// A floor, and 2 m above it a window that shines down, 2 m × 2 m.
Scene room_under_a_window(int width, int height, const std::vector<std::uint8_t>& rgb) {
  Scene scene;
  add_floor(scene, add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f})));
  TextureImage image;
  image.width = width, image.height = height;
  for (std::size_t i = 0; i < rgb.size(); i += 3)
    image.rgba.insert(image.rgba.end(), {rgb[i], rgb[i + 1], rgb[i + 2], 255});
  scene.textures = {image};
  Material glass = diffuse_material({});
  glass.double_sided = false;
  glass.emission = {8, 8, 6};
  glass.emission_map.image = 0, glass.emission_map.nearest = true;
  glass.emission_map_lights = true;
  add_quad(scene, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, add_material(scene, glass));
  return scene;
}

/// Half a window as a light by itself.
Light pane(float x, const Vec3& emission) {
  Light light;
  light.type = LightType::rect;
  light.position = {x, 2, 0};
  light.normal = {0, -1, 0};
  light.edge_u = {1, 0, 0}, light.edge_v = {0, 0, 2};
  light.emission = emission;
  return light;
}

TEST_P(TexturedLight, OfTwoColoursIsTheSumOfTwoPanes) {
  Scene scene = room_under_a_window(2, 1, {255, 0, 0, 0, 0, 255});
  finish_scene(scene, "window");
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].emission, Vec3(8, 0, 0));
  EXPECT_EQ(scene.lights[1].emission, Vec3(0, 0, 6));
  constexpr int side = 40;
  const std::vector<Vec3> found = baked(scene, side, 1024);
  Scene panes = scene;
  panes.lights = {pane(-0.5f, Vec3(1)), pane(0.5f, Vec3(1))};
  const LightViews views(panes);
  const DirectLight direct(views);
  const PlanarChart chart = chart_of_quad(scene, 0, side, side);
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const Vec3 p = chart.texel(static_cast<float>(i), static_cast<float>(j));
      const float left = 8 * direct.irradiance(0, p, {0, 1, 0}, Horizon::exact);
      const float right = 6 * direct.irradiance(1, p, {0, 1, 0}, Horizon::exact);
      const Vec3& e = found[static_cast<std::size_t>(j * side + i)];
      ASSERT_NEAR(e.x, left, 0.01f * left + 1e-5f) << i << " " << j;
      ASSERT_NEAR(e.z, right, 0.01f * right + 1e-5f) << i << " " << j;
      ASSERT_EQ(e.y, 0);
    }
}

TEST_P(TexturedLight, CastsColouredShadowsLikeTwoPanes) {
  Scene scene = room_under_a_window(2, 1, {255, 0, 0, 0, 0, 255});
  add_quad(scene, {-0.4f, 0.8f, 0.7f}, {0.9f, 0, 0}, {0, 0, -1.2f}, 0);
  Scene panes = scene;
  panes.instances.erase(panes.instances.begin() + 1);
  panes.lights = {pane(-0.5f, {8, 0, 0}), pane(0.5f, {0, 0, 6})};
  finish_scene(scene, "window");
  constexpr int side = 40;
  const std::vector<Vec3> found = baked(scene, side, 256), expected = baked(panes, side, 1024);
  double sum = 0, coloured = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Vec3 gap = found[i] - expected[i];
    sum += dot(gap, gap);
    coloured += found[i].x * 6 > 3 * found[i].z * 8 || found[i].z * 8 > 3 * found[i].x * 6;
  }
  EXPECT_LT(std::sqrt(sum / static_cast<double>(found.size())), 0.05);
  EXPECT_GT(coloured, 20);
}

TEST_P(TexturedLight, IsSampledWhereItIsBright) {
  // A pane of 1/16 of the window's area, and black glass.
  std::vector<std::uint8_t> rgb(48, 0);
  rgb[3 * 6] = rgb[3 * 6 + 1] = rgb[3 * 6 + 2] = 255;
  Scene scene = room_under_a_window(4, 4, rgb);
  finish_scene(scene, "window");
  ASSERT_EQ(scene.lights.size(), 1u) << "grey glass is one light";
  const LightViews views(scene);
  BakeOptions options;
  options.light_samples = 64;
  const PlanarChart c = chart_of_quad(scene, 0, 4, 4);
  const SampledLight light =
      LightSampler(views, options)
          .sample(0, {{c.base, c.base + c.edge_x, c.base + c.edge_x + c.edge_y, c.base + c.edge_y},
                      c.normal});
  ASSERT_EQ(light.samples.size(), 64u);
  float area = 0;
  for (const LightSample& s : light.samples) {
    // Texel (2, 1) of 4 × 4: u along x, v along z.
    EXPECT_TRUE(s.position.x >= -1e-5f && s.position.x <= 0.5f + 1e-5f);
    EXPECT_TRUE(s.position.z >= -0.5f - 1e-5f && s.position.z <= 1e-5f);
    area += s.weight;
  }
  EXPECT_NEAR(area, 0.25f, 1e-5f);
  // Near the floor's middle it is as bright as a small rect there.
  Scene pane_alone = scene;
  Light pane;
  pane.type = LightType::rect;
  pane.position = {0.25f, 2, -0.25f};
  pane.normal = {0, -1, 0};
  pane.edge_u = {0.5f, 0, 0}, pane.edge_v = {0, 0, 0.5f};
  pane_alone.lights = {pane};
  const LightViews pane_views(pane_alone);
  const float truth =
      8 * DirectLight(pane_views).irradiance(0, c.texel(1, 1), c.normal, Horizon::exact);
  EXPECT_NEAR(baked(scene, 4, 64)[5].x, truth, 0.005f * truth);
}

}  // namespace
}  // namespace penumbra::bake
