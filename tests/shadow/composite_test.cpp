// Composites act between objects; within one object it is always the minimum.
#include <gtest/gtest.h>

#include "shadow/shadows.h"

namespace penumbra {
namespace {

// A light of radius 0.5 at height 10 over the origin: D / A = 0.1. Spheres of radius 1 at height 5,
// 1.25 and 1.3 from the ray: clearances 0.05 and 0.06, τ = 0.5 and 0.6.
Scene two_spheres(std::uint32_t second_object) {
  Scene scene;
  scene.materials.emplace_back();
  scene.objects = {{"first"}, {"second"}};
  scene.spheres.push_back({{1.25f, 5, 0}, 1, 0, 0});
  scene.spheres.push_back({{-1.3f, 5, 0}, 1, 0, second_object});
  Light light;
  light.type = LightType::sphere;
  light.position = {0, 10, 0};
  light.radius = 0.5f;
  scene.lights.push_back(light);
  return scene;
}

// The same clearances by squares across the ray's side.
Scene two_squares(std::uint32_t second_object) {
  Scene scene = two_spheres(second_object);
  scene.spheres.clear();
  for (const float edge : {0.25f, -0.3f}) {
    Mesh mesh;
    const float far = edge * 8;
    mesh.positions = {{edge, 5, -1}, {edge, 5, 1}, {far, 5, 1}, {far, 5, -1}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    Instance instance;
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    instance.object = edge > 0 ? 0 : second_object;
    scene.meshes.push_back(mesh);
    scene.instances.push_back(instance);
  }
  return scene;
}

float fraction(const Scene& scene, Composite composite, Profile profile = Profile::cubic) {
  const World world(scene);
  ShadowOptions options;
  options.tolerance = 0;
  options.composite = composite;
  options.profile = profile;
  ShadowCounts counts;
  return Shadows(world, options).visibility({{0, 0, 0}, {0, 1, 0}}, 0, 0, counts).fraction;
}

TEST(Composite, ActsBetweenObjects) {
  const float s1 = 0.5f, s2 = 3 * 0.36f - 2 * 0.216f;
  for (const Scene& scene : {two_spheres(1), two_squares(1)}) {
    EXPECT_NEAR(fraction(scene, Composite::min), s1, 1e-4f);
    EXPECT_NEAR(fraction(scene, Composite::multiply), s1 * s2, 1e-4f);
    EXPECT_NEAR(fraction(scene, Composite::add), s1 + s2 - 1, 1e-4f);
    EXPECT_NEAR(fraction(scene, Composite::multiply, Profile::linear), 0.5f * 0.6f, 1e-4f);
  }
}

TEST(Composite, OneObjectHasItsMinimum) {
  for (const Scene& scene : {two_spheres(0), two_squares(0)})
    for (const Composite composite : {Composite::min, Composite::multiply, Composite::add})
      EXPECT_NEAR(fraction(scene, composite), 0.5f, 1e-4f);
}

TEST(Composite, ShadowsThatAddUpToMoreThanAllAreDark) {
  Scene scene = two_spheres(1);
  scene.spheres[0].center.x = 1.15f, scene.spheres[1].center.x = -1.2f;
  EXPECT_EQ(fraction(scene, Composite::add), 0);
  EXPECT_GT(fraction(scene, Composite::multiply), 0);
}

TEST(Composite, WhatBlocksTheRayIsDarkInAll) {
  Scene scene = two_spheres(1);
  scene.spheres[0].center.x = 0.5f;
  for (const Composite composite : {Composite::min, Composite::multiply, Composite::add})
    EXPECT_EQ(fraction(scene, composite), 0);
}

}  // namespace
}  // namespace penumbra
