// The points that `area` sums give the irradiance that the closed forms give.
#include <gtest/gtest.h>

#include <numbers>

#include "render/direct_light.h"
#include "shadow/shadows.h"

namespace penumbra {
namespace {

Light light_of(LightType type) {
  Light light;
  light.type = type;
  light.position = {0.6f, 1.5f, -0.3f};
  light.normal = normalize(Vec3{-0.2f, -1, 0.1f});
  light.direction = normalize(Vec3{-0.3f, -1, 0.2f});
  light.angular_diameter = 0.3f;
  light.radius = type == LightType::segment ? 0.01f : 0.4f;
  light.emission = Vec3(1.0f);
  const Frame frame = frame_around(light.normal);
  light.edge_u = frame.u, light.edge_v = frame.v * 0.7f;
  return light;
}

TEST(LightPoints, MeanOfWeightTimesCosineIsTheIrradiance) {
  for (const LightType type :
       {LightType::sphere, LightType::disk, LightType::rect, LightType::segment, LightType::sun}) {
    Scene scene;
    scene.lights.push_back(light_of(type));
    const World world(scene);
    ShadowOptions options;
    options.kind = ShadowKind::area;
    options.light_samples = 4096;
    options.skip_lit = false;
    const Shadows shadows(world, options);
    const DirectLight lights(shadows.lights());
    for (const Vec3& at : {Vec3{0, 0, 0}, Vec3{1.5f, 0, 0.5f}, Vec3{0.6f, 0.3f, 0.5f}}) {
      std::vector<LightPoint> points;
      ShadowCounts counts;
      shadows.light_points({at, {0, 1, 0}}, 0, 1, points, counts);
      ASSERT_EQ(points.size(), 4096u);
      double sum = 0;
      for (const LightPoint& p : points) sum += p.weight * std::max(p.direction.y, 0.0f);
      // Of a sun, weights are relative: irradiance on a facing surface is 1, but for the cosine.
      const double expected = lights.irradiance(0, at, {0, 1, 0}, Horizon::exact);
      EXPECT_NEAR(sum / 4096, expected, 0.01 * expected) << to_string(type);
      EXPECT_GT(expected, 0);
    }
  }
}

}  // namespace
}  // namespace penumbra
