// Many rays at once meet what each alone meets, on distance fields.
#include <gtest/gtest.h>

#include "geometry/world.h"
#include "scene/json/builder.h"

namespace penumbra {
namespace {

Scene scene() {
  return json::read_scene(json::Document("s.json", R"({"materials": {"a": {}, "b": {}}, "objects": [
      {"type": "sphere", "center": [1.5, 0.3, 0], "radius": 0.3, "material": "b"},
      {"type": "sdf", "material": "a", "root": {"op": "smooth_union", "k": 0.2, "children": [
        {"shape": "plane", "normal": [0, 1, 0]},
        {"shape": "box", "center": [0, 0.4, 0], "half_size": [0.4, 0.4, 0.4]},
        {"shape": "torus", "center": [-1.2, 0.5, 0.3], "major_radius": 0.4, "minor_radius": 0.1}
      ]}}]})"));
}

/// Sixteen at a time about a common way, as a picture's are; some miss everything.
std::vector<Ray> rays(const Vec3& eye, float spread) {
  std::vector<Ray> rays;
  for (int block = 0; block < 48; ++block)
    for (int i = 0; i < 16; ++i) {
      const float x =
          -2 + 0.5f * static_cast<float>(block % 8) + spread * static_cast<float>(i % 4);
      const float y =
          -0.6f + 0.6f * static_cast<float>(block / 8) + spread * static_cast<float>(i / 4);
      rays.push_back({eye, normalize(Vec3(x, y, 0) - eye)});
    }
  rays.resize(rays.size() - 5);  // not a multiple of anything
  return rays;
}

void expect_same(const World& world, const std::vector<Ray>& rays) {
  std::vector<std::optional<Hit>> together(rays.size());
  world.intersect(rays, together.data());
  std::vector<Ray> met;
  std::vector<Hit> hits;
  int missed = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto alone = world.intersect(rays[i]);
    ASSERT_EQ(together[i].has_value(), alone.has_value()) << i;
    if (!alone) {
      ++missed;
      continue;
    }
    EXPECT_NEAR(together[i]->t, alone->t, 1e-4f * alone->t) << i;
    EXPECT_EQ(together[i]->primitive.instance, alone->primitive.instance) << i;
    met.push_back(rays[i]);
    hits.push_back(*together[i]);
  }
  EXPECT_GT(missed, 0);
  ASSERT_GT(met.size(), 100u);
  std::vector<Surface> surfaces(met.size());
  world.surfaces(met, hits, surfaces);
  for (std::size_t i = 0; i < met.size(); ++i) {
    const Surface alone = world.surface(met[i], hits[i]);
    EXPECT_EQ(surfaces[i].position, alone.position);
    EXPECT_EQ(surfaces[i].normal, alone.normal);
    EXPECT_EQ(surfaces[i].material, alone.material);
    EXPECT_EQ(surfaces[i].primitive.instance, alone.primitive.instance);
  }
}

TEST(Solids, ManyRaysMeetWhatEachMeets) {
  const Scene fields = scene();
  const World world(fields, {.cone_tree = false});
  for (const float spread : {0.005f, 0.1f, 1.0f}) expect_same(world, rays({0.2f, 1.5f, 5}, spread));
}

TEST(Solids, RaysThatStartInsideAreHitAtOnce) {
  const Scene fields = scene();
  const World world(fields, {.cone_tree = false});
  const std::vector<Ray> inside = rays({0, 0.4f, 0}, 0.01f);
  std::vector<std::optional<Hit>> hits(inside.size());
  world.intersect(inside, hits.data());
  for (const auto& hit : hits) {
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->t, 0);
  }
}

}  // namespace
}  // namespace penumbra
