// The cone that spares the area light its rays must prove what it says.
#include "shadow/light_guard.h"

#include <gtest/gtest.h>

#include <random>

namespace penumbra {
namespace {

using Random = std::mt19937;

float uniform(Random& random, float lo, float hi) {
  return lo + (hi - lo) * static_cast<float>(random() >> 8) * 0x1p-24f;
}

Light sphere_light(const Vec3& position, float radius) {
  Light light;
  light.type = LightType::sphere;
  light.position = position;
  light.radius = radius;
  return light;
}

Scene one_sphere(const Vec3& center, float radius, const Light& light) {
  Scene scene;
  scene.materials.emplace_back();
  scene.objects.push_back({"sphere"});
  scene.spheres.push_back({center, radius, 0, 0});
  scene.lights.push_back(light);
  return scene;
}

bool proven(const World& world, const Receiver& receiver) {
  const LightViews lights(world.scene());
  ShadowCounts counts;
  return whole_light_is_seen(world, lights, receiver, 0, counts);
}

ShadowOptions without_guard() {
  ShadowOptions options;
  options.kind = ShadowKind::area;
  options.light_samples = 1024;
  options.skip_lit = false;
  return options;
}

float traced(const Shadows& shadows, const Receiver& receiver) {
  ShadowCounts counts;
  return shadows.visibility(receiver, 0, 1, counts).fraction;
}

constexpr Receiver origin{{0, 0, 0}, {0, 1, 0}};

TEST(LightGuard, SpheresBesideTheLightAreSeen) {
  // (d − R) / t₀ of the paper overstates how far a large near sphere is from the cone.
  Random random(11);
  int lit = 0, cut = 0;
  for (int i = 0; i < 40; ++i) {
    const float radius = uniform(random, 0.1f, 1.5f), height = uniform(random, -0.5f, 2);
    const Light light = sphere_light({uniform(random, -1, 1), 3, 0}, uniform(random, 0.2f, 1.5f));
    const Scene scene = one_sphere({radius, height, 0}, radius, light);
    const World world(scene);
    const Shadows shadows(world, without_guard());
    for (int k = 0; k < 40; ++k) {
      const Vec3 at{uniform(random, -1.2f, 0), 0, uniform(random, -0.3f, 0.3f)};
      const Receiver receiver{at, {0, 1, 0}};
      const bool seen = proven(world, receiver);
      const float fraction = traced(shadows, receiver);
      lit += seen, cut += fraction > 0 && fraction < 1;
      if (seen) {
        ASSERT_EQ(fraction, 1) << "scene " << i << " point " << k;
      }
    }
  }
  EXPECT_GT(lit, 300);
  EXPECT_GT(cut, 300);
}

TEST(LightGuard, ASphereWhoseCentreIsBehindThePointIsSeen) {
  // It bulges over the point's plane across the ray, beside the ray.
  const Scene scene = one_sphere({1.01f, -0.1f, 0}, 1, sphere_light({0, 3, 0}, 1.2f));
  const World world(scene);
  ASSERT_LT(traced(Shadows(world, without_guard()), origin), 0.95f);
  EXPECT_FALSE(proven(world, origin));
}

// A square of 2 × 2 m at height 1, turned by `tilt` about z, with a round hole of radius 0.5 m.
Scene pierced_roof(float tilt, const Light& light) {
  constexpr int texels = 128;
  Scene scene;
  TextureImage image{"hole", texels, texels, {}};
  for (int y = 0; y < texels; ++y)
    for (int x = 0; x < texels; ++x) {
      const float u = 2 * (float(x) + 0.5f) / texels - 1, v = 2 * (float(y) + 0.5f) / texels - 1;
      for (int c = 0; c < 4; ++c) image.rgba.push_back(c == 3 && u * u + v * v < 0.25f ? 0 : 255);
    }
  scene.textures.push_back(image);
  Material material;
  material.alpha_cutoff = 0.5f;
  material.diffuse_map.image = 0;
  scene.materials.push_back(material);
  scene.objects.push_back({"roof"});
  Mesh mesh;
  const Vec3 u{std::cos(tilt), std::sin(tilt), 0}, v{0, 0, -1}, center{0, 1, 0};
  mesh.positions = {center - u - v, center + u - v, center + u + v, center - u + v};
  mesh.uv[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  scene.meshes.push_back(mesh);
  scene.instances.emplace_back();
  scene.lights.push_back(light);
  return scene;
}

TEST(LightGuard, TheEdgeOfAHoleIsSeenHoweverItIsTurned) {
  Random random(12);
  int cut = 0;
  for (int i = 0; i < 20; ++i) {
    const Light light =
        sphere_light({uniform(random, -0.3f, 0.3f), 3, 0}, uniform(random, 0.1f, 1));
    const Scene scene = pierced_roof(uniform(random, -1.2f, 1.2f), light);
    const World world(scene);
    const Shadows shadows(world, without_guard());
    for (int k = 0; k < 10; ++k) {
      const Receiver receiver{{uniform(random, -0.3f, 0.3f), 0, 0}, {0, 1, 0}};
      const float fraction = traced(shadows, receiver);
      cut += fraction > 0 && fraction < 1;
      if (proven(world, receiver)) {
        ASSERT_EQ(fraction, 1) << "scene " << i << " point " << k;
      }
    }
  }
  EXPECT_GT(cut, 30);
}

}  // namespace
}  // namespace penumbra
