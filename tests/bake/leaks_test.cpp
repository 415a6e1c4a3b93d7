// No light through walls, corners and cracks.
#include <gtest/gtest.h>

#include "bake/baked_irradiance.h"
#include "bake/charts.h"
#include "bake/driver.h"
#include "base/parallel.h"
#include "render/small_scenes.h"

namespace penumbra::bake {
namespace {

class Leaks : public ::testing::TestWithParam<BakeDevice> {
 protected:
  void SetUp() override { skip_without_driver(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Devices, Leaks,
                         ::testing::Values(BakeDevice::cpu, BakeDevice::gl, BakeDevice::rays));

Vec3 turned(const Vec3& p) {
  const Vec3 x = normalize(Vec3{0.7f, 0.3f, -0.2f}), helper{0.1f, 1, 0.3f};
  const Vec3 z = normalize(cross(x, helper)), y = cross(z, x);
  return x * p.x + y * p.y + z * p.z + Vec3{3.1f, -1.7f, 0.9f};
}

/// A box seen from inside, askew in space: six quads that share corners.
Scene closed_box() {
  Scene scene;
  const auto grey = add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f}));
  const auto corner = [](int i) {
    return turned({i & 1 ? 1.0f : -1.0f, i & 2 ? 0.8f : -0.7f, i & 4 ? 0.9f : -1.2f});
  };
  const int faces[6][4] = {{0, 4, 5, 1}, {2, 3, 7, 6}, {0, 1, 3, 2},
                           {4, 6, 7, 5}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  for (const auto& f : faces) {
    add_quad(scene, corner(f[0]), {}, {}, grey);
    Mesh& mesh = scene.meshes.back();
    mesh.positions = {corner(f[0]), corner(f[1]), corner(f[2]), corner(f[3])};
  }
  return scene;
}

Light outside(LightType type, int place) {
  const Vec3 places[] = {{0.3f, 4, 0.2f}, {-3, 0.1f, 0.4f}, {2.5f, 2.6f, 2.7f}};
  Light light;
  light.type = type;
  light.position = turned(places[place]);
  const Vec3 in = normalize(turned({0, 0, 0}) - light.position);
  light.normal = light.direction = in;
  const Frame f = frame_around(in);
  light.edge_u = f.u * 1.5f, light.edge_v = f.v * 1.1f;
  light.radius = 0.6f;
  light.angular_diameter = 0.3f;
  light.emission = Vec3(100);
  return light;
}

TEST_P(Leaks, AClosedBoxLitFromOutsideIsBlackToTheLastTexel) {
  Scene scene = closed_box();
  for (const LightType type : {LightType::sphere, LightType::rect, LightType::sun, LightType::point,
                               LightType::disk, LightType::segment})
    for (int place = 0; place < 3; ++place) scene.lights.push_back(outside(type, place));
  const World world(scene, {.cone_tree = false});
  BakeOptions options;
  options.device = GetParam();
  options.light_samples = 25;
  const BakedIrradiance baked(world, options);
  for (std::uint32_t wall = 0; wall < 6; ++wall) {
    PlanarChart chart = chart_of_quad(scene, wall, 61, 77);
    const Vec3 middle = chart.base + (chart.edge_x + chart.edge_y) * 0.5f;
    if (dot(chart.normal, turned({0, 0, 0}) - middle) < 0) chart.normal = -chart.normal;
    std::vector<Vec3> found(61 * 77);
    baked.of_chart(chart, found);
    for (std::size_t i = 0; i < found.size(); ++i)
      ASSERT_EQ(found[i], Vec3()) << "wall " << wall << " texel " << i % 61 << ", " << i / 61;
  }
}

TEST_P(Leaks, OverlappingCoplanarWallsThrowNoShadow) {
  Scene scene;
  const auto grey = add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f}));
  add_quad(scene, turned({-1, 0, 1}), turned({1, 0, 1}) - turned({-1, 0, 1}),
           turned({-1, 0, -1}) - turned({-1, 0, 1}), grey);
  add_quad(scene, turned({-0.5f, 0, 2}), turned({1, 0, 1}) - turned({-1, 0, 1}),
           turned({-1, 0, -1}) - turned({-1, 0, 1}), grey);
  Light light = outside(LightType::sphere, 0);
  scene.lights.push_back(light);
  const World world(scene, {.cone_tree = false});
  BakeOptions options;
  options.device = GetParam();
  const BakedIrradiance baked(world, options);
  std::vector<float> found(64 * 64);
  baked.visible_fractions(chart_of_quad(scene, 0, 64, 64), 0, found);
  for (const float f : found) ASSERT_NEAR(f, 1, 1e-5f);
}

TEST_P(Leaks, TheSameBytesAtAnyNumberOfThreads) {
  const Scene scene = still_life();
  const World world(scene, {.cone_tree = false});
  BakeOptions options;
  options.device = GetParam();
  options.light_samples = 16;
  const BakedIrradiance baked(world, options);
  const PlanarChart chart = chart_of_quad(scene, 0, 300, 700);
  std::vector<Vec3> one(300 * 700), many(300 * 700);
  {
    const ThreadLimit limit(1);
    baked.of_chart(chart, one);
  }
  {
    const ThreadLimit limit(4);
    baked.of_chart(chart, many);
  }
  EXPECT_TRUE(one == many);
}

}  // namespace
}  // namespace penumbra::bake
