// What more samples cost (Heckbert and Herf 1997, section 3.9).
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "bake/bake_scenes.h"
#include "bake/baked_irradiance.h"
#include "bake/plan.h"
#include "base/parallel.h"

namespace penumbra::bake {
namespace {

/// A floor under a hundred plates.
Scene plates() {
  Scene scene;
  test::add_quad(scene, {-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
  for (int i = 0; i < 100; ++i) {
    const float x = -3.6f + 0.8f * static_cast<float>(i % 10),
                z = -3.6f + 0.8f * static_cast<float>(i / 10);
    const float y = 0.3f + 0.1f * static_cast<float>(i % 7);
    const std::uint32_t plate = test::add_quad(scene, {x, y, z}, {0.4f, 0.1f, 0}, {0, 0.1f, -0.4f});
    scene.objects[plate].receives = false;
  }
  Light light;
  light.type = LightType::rect;
  light.position = {0.5f, 4, -0.3f};
  light.normal = {0, -1, 0};
  light.edge_u = {1, 0, 0}, light.edge_v = {0, 0, 1};
  light.emission = Vec3(1);
  scene.lights.push_back(light);
  finish_scene(scene, "plates");
  return scene;
}

// Neighbouring samples share the walk through the scene, so that many of them cost less each. The
// least of several turns, taken alternately, and twice the time are beyond the noise of a busy
// machine.
TEST(Scaling, TimeASampleDoesNotGrowWithTheirNumber) {
  const Scene scene = plates();
  const World world(scene, {.cone_tree = false});
  TextureOptions textures;
  textures.texel_size = 8.0f / 320;
  const Plan plan = make_plan(scene, textures);
  const PlanarChart& floor = plan.charts.at(0).shape;
  std::vector<Vec3> out(static_cast<std::size_t>(floor.width) *
                        static_cast<std::size_t>(floor.height));
  const ThreadLimit one(1);
  constexpr int counts[] = {8, 512};
  double least[2];
  std::ranges::fill(least, std::numeric_limits<double>::infinity());
  for (int turn = 0; turn < 7; ++turn)
    for (int i = 0; i < 2; ++i) {
      BakeOptions options;
      options.device = BakeDevice::cpu;
      options.light_samples = counts[i];
      const BakedIrradiance irradiance(world, options);
      const int repeats = i == 0 ? 8 : 1;
      const auto begin = std::chrono::steady_clock::now();
      for (int k = 0; k < repeats; ++k) irradiance.of_chart(floor, out);
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
      least[i] = std::min(least[i], taken.count() / (repeats * counts[i]));
    }
  EXPECT_LT(least[1], 2 * least[0]) << "seconds a sample: " << least[0] << ", " << least[1];
}

}  // namespace
}  // namespace penumbra::bake
