#include "bake/light_textures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bake/surface_light.h"
#include "bake/triangulate.h"
#include "render/small_scenes.h"
#include "scene/finish.h"

namespace penumbra::bake {
namespace {

// A ball under a lamp: several charts, whose borders the light runs across without a step.
TEST(LightTextures, CurvedChartsMeetWithoutSeams) {
  Scene round;
  add_sphere(round, {0, 1, 0}, 1, add_material(round, diffuse_material(Vec3(0.5f))));
  add_camera(round, {0, 1, 5}, {0, 1, 0}, 0.7f);
  add_sphere_light(round, {2, 4, 1}, 0.5f, 10);
  finish_scene(round, "round");
  const Scene scene = triangulated(round, {});
  const World world(scene, {.cone_tree = false});
  BakeOptions options;
  options.device = BakeDevice::rays, options.light_samples = 16;
  const BakedIrradiance irradiance(world, options);
  TextureOptions textures;
  textures.texel_size = 0.08f;
  const Plan plan = make_plan(scene, textures);
  ASSERT_GT(plan.charts.size(), 1u);
  Progress progress;
  const LightTextures baked(scene, plan, irradiance, {}, progress);

  const WorldMesh& mesh = *plan.meshes[0];
  double squares = 0;
  float most = 0, brightest = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    const SurfacePoint point = surface_point(mesh, {t, 0.3f, 0.3f, false});
    float truth = 0, found = 0;
    irradiance.unit_irradiances({&point, 1}, 0, {&truth, 1});
    TilePoint seen;
    seen.primitive = {0, t}, seen.normal = point.normal, seen.shading.position = point.position;
    baked.irradiances(0, {&seen, 1}, {&found, 1});
    most = std::max(most, std::abs(found - truth));
    brightest = std::max(brightest, truth);
    squares += std::pow(double(found) - truth, 2);
  }
  EXPECT_GT(brightest, 0.04f);
  EXPECT_LT(most, 0.03f * brightest);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(mesh.triangle_count())), 0.004 * brightest);
}

}  // namespace
}  // namespace penumbra::bake
