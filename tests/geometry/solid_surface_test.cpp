// Surfaces of distance fields, as rays find them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "geometry/embree_scene.h"
#include "geometry/world.h"
#include "scene/json/builder.h"

namespace penumbra {
namespace {

Scene scene_of(const std::string& root) {
  return json::read_scene(json::Document(
      "s.json",
      R"({"materials": {"a": {}}, "objects": [{"type": "sdf", "material": "a", "root": )" + root +
          "}]}"));
}

// Rays that graze the edges of a box: what they meet belongs to a side that faces them.
TEST(SolidSurface, NormalsAtSilhouettesBelongToASideThatIsSeen) {
  const Scene scene = scene_of(R"({"shape": "box", "half_size": [1, 1, 1]})");
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

// The field of an ellipsoid grows faster outside than inside. Hits are as exact there too, so that
// a convex shape casts no shadow on what faces the light.
TEST(SolidSurface, EllipsoidsAreMetOnTheSurface) {
  const Scene scene = scene_of(R"({"shape": "ellipsoid", "radii": [1, 0.6, 0.4]})");
  const World world(scene, {.cone_tree = false});
  const Vec3 eye{1.7f, 1.9f, 4.6f}, to_light = normalize(Vec3{0.55f, 0.8f, 0.5f});
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const float way = 1e-3f * static_cast<float>(i);
    const Vec3 target{way - 1, 0.4f - 0.3f * way, 0};
    const Ray ray{eye, normalize(target - eye)};
    const auto hit = world.intersect(ray);
    if (!hit) continue;
    const Surface s = world.surface(ray, *hit);
    const Vec3d p(s.position), unit(p.x, p.y / 0.6, p.z / 0.4);
    const double slope = 2 * length(Vec3d(unit.x, unit.y / 0.6, unit.z / 0.4));
    const float epsilon = world.epsilon_at(s.position);
    EXPECT_LT(std::abs(dot(unit, unit) - 1) / slope, 0.25 * epsilon) << i;
    if (dot(s.normal, to_light) < 0.05f) continue;
    EXPECT_FALSE(world.occluded(ShadowRay{s.position + s.normal * epsilon, to_light})) << i;
    ++met;
  }
  EXPECT_GT(met, 500);
}

}  // namespace
}  // namespace penumbra
