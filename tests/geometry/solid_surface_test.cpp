// Surfaces of distance fields, as rays find them.
#include <gtest/gtest.h>

#include <random>

#include "geometry/world.h"
#include "scene/json/builder.h"

namespace penumbra {
namespace {

// Rays that graze the edges of a box: what they meet belongs to a side that faces them.
TEST(SolidSurface, NormalsAtSilhouettesBelongToASideThatIsSeen) {
  const Scene scene = json::read_scene(json::Document(
      "s.json", R"({"materials": {"a": {}}, "objects": [{"type": "sdf", "material": "a",
                    "root": {"shape": "box", "half_size": [1, 1, 1]}}]})"));
  const World world(scene, {.cone_tree = false});
  const Vec3 eye{3, 2.3f, 4.6f};
  std::mt19937 random(1);
  std::uniform_real_distribution<float> along(-0.9f, 0.9f), inwards(0, 2e-3f);
  int met = 0;
  for (int i = 0; i < 3000; ++i) {
    // Edges between a side that is seen and one that is not.
    const float way = along(random), in = 1 - inwards(random);
    const Vec3 targets[] = {{in, way, -1}, {1, -in, way}, {way, in, -1}, {-1, in, way}};
    const Vec3 target = targets[i % 4];
    const Ray ray{eye, normalize(target - eye)};
    const auto hit = world.intersect(ray);
    if (!hit) continue;
    const Surface s = world.surface(ray, *hit);
    EXPECT_TRUE(s.front);
    EXPECT_GT(s.normal.x, -0.8f);
    EXPECT_GT(s.normal.y, -0.8f);
    EXPECT_GT(s.normal.z, -0.8f);
    EXPECT_LT(dot(s.normal, ray.direction), 0);
    ++met;
  }
  EXPECT_GT(met, 1000);
}

}  // namespace
}  // namespace penumbra
