// Centre, distance and diameter of every type of light, and which surfaces are the light itself.
#include "shadow/light_view.h"

#include <gtest/gtest.h>

#include <numbers>

#include "scene/finish.h"
#include "shadow/shadows.h"

namespace penumbra {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

Light light_above(LightType type) {
  Light light;
  light.type = type;
  light.position = {0, 4, 0};
  light.normal = light.direction = {0, -1, 0};
  return light;
}

// D / A from the origin, four metres below.
float diameter_over_distance(const Light& light) {
  Scene scene;
  scene.lights.push_back(light);
  const auto view = LightViews(scene).view(0, {0, 0, 0});
  EXPECT_EQ(view->direction, (Vec3{0, 1, 0}));
  EXPECT_EQ(view->distance, light.type == LightType::sun ? INFINITY : 4);
  return view->diameter_over_distance;
}

TEST(LightView, DiametersAreParkers) {
  Light light = light_above(LightType::point);
  EXPECT_EQ(diameter_over_distance(light), 0);
  for (const LightType type : {LightType::sphere, LightType::disk}) {
    light = light_above(type);
    light.radius = 0.3f;
    EXPECT_FLOAT_EQ(diameter_over_distance(light), 0.6f / 4);
  }
  light = light_above(LightType::rect);
  light.edge_u = {2, 0, 0}, light.edge_v = {0, 0, 0.5f};
  EXPECT_FLOAT_EQ(diameter_over_distance(light), 2 / std::sqrt(pi) / 4);
  light = light_above(LightType::segment);
  light.edge_u = {2, 0, 0}, light.radius = 0.1f;
  EXPECT_FLOAT_EQ(diameter_over_distance(light), 2 * std::sqrt(0.4f / pi) / 4);
  light = light_above(LightType::sun);
  light.angular_diameter = 0.2f;
  EXPECT_FLOAT_EQ(diameter_over_distance(light), 2 * std::tan(0.1f));
}

// An emissive octahedron of radius 0.3 at height 3.
Scene lamp(bool cut_out) {
  Scene scene;
  Material& material = scene.materials.emplace_back();
  material.emission = {1, 1, 1};
  material.double_sided = false;
  if (cut_out) {
    scene.textures.push_back({"opaque", 1, 1, {255, 255, 255, 255}});
    material.diffuse_map.image = 0;
    material.alpha_cutoff = 0.5f;
  }
  scene.objects.push_back({"lamp"});
  Mesh mesh;
  const Vec3 c{0, 3, 0}, x{0.3f, 0, 0}, y{0, 0.3f, 0}, z{0, 0, 0.3f};
  mesh.positions = {c + x, c + z, c - x, c - z, c + y, c - y};
  mesh.uv[0].resize(6);
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t next = (i + 1) % 4;
    mesh.indices.insert(mesh.indices.end(), {next, i, 4, i, next, 5});
  }
  scene.meshes.push_back(mesh);
  scene.instances.emplace_back();
  finish_scene(scene, "lamp");
  return scene;
}

float fraction(const Scene& scene, ShadowKind kind) {
  const World world(scene);
  ShadowOptions options;
  options.kind = kind;
  ShadowCounts counts;
  return Shadows(world, options).visibility({{0, 0, 0}, {0, 1, 0}}, 0, 0, counts).fraction;
}

constexpr ShadowKind kinds[] = {ShadowKind::hard, ShadowKind::parker, ShadowKind::area};

TEST(LightView, AMeshLightIsItsFacesThatAreTurnedToThePoint) {
  const Scene scene = lamp(false);
  ASSERT_EQ(scene.lights.size(), 1u);
  const auto view = LightViews(scene).view(0, {0, 0, 0});
  EXPECT_NEAR(view->distance, 2.9f, 1e-5f);
  const float area = 4 * std::sqrt(3.0f) / 4 * 0.18f;
  EXPECT_NEAR(view->diameter_over_distance, 2 * std::sqrt(area / pi) / 2.9f, 1e-5f);
}

TEST(LightView, AMeshLightDoesNotOccludeItself) {
  for (const bool cut_out : {false, true}) {
    Scene scene = lamp(cut_out);
    for (const ShadowKind kind : kinds) EXPECT_EQ(fraction(scene, kind), 1) << int(kind);
    scene.spheres.push_back({{0, 1.5f, 0}, 0.5f, 0, 0});
    for (const ShadowKind kind : kinds) EXPECT_EQ(fraction(scene, kind), 0) << int(kind);
  }
}

TEST(LightView, OfAnOpenDoubleSidedMeshAllFacesCount) {
  // Two triangles of half a square metre in one plane, one turned to the origin and one away.
  for (const bool double_sided : {false, true}) {
    Scene scene;
    Material& material = scene.materials.emplace_back();
    material.emission = {1, 1, 1};
    material.double_sided = double_sided;
    scene.objects.push_back({"sheet"});
    Mesh mesh;
    mesh.positions = {{0, 4, 0}, {1, 4, 0}, {0, 4, 1}, {-1, 4, 0}};
    mesh.indices = {0, 1, 2, 0, 3, 2};
    scene.meshes.push_back(mesh);
    scene.instances.emplace_back();
    finish_scene(scene, "sheet");
    ASSERT_EQ(scene.lights.size(), 1u);
    const auto view = LightViews(scene).view(0, {0, 0, 0});
    const float diameter = view->diameter_over_distance * view->distance;
    EXPECT_NEAR(diameter, 2 * std::sqrt((double_sided ? 1 : 0.5f) / pi), 1e-5f);
  }
}

TEST(LightView, TheCeilingOfAFlatLightDoesNotOcclude) {
  for (const LightType type : {LightType::disk, LightType::rect}) {
    Scene scene;
    scene.materials.emplace_back();
    scene.objects.push_back({"ceiling"});
    Mesh mesh;
    mesh.positions = {{-9, 4, -9}, {9, 4, -9}, {9, 4, 9}, {-9, 4, 9}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes.push_back(mesh);
    scene.instances.emplace_back();
    Light light = light_above(type);
    light.edge_u = {1, 0, 0}, light.edge_v = {0, 0, 1}, light.radius = 0.5f;
    scene.lights.push_back(light);
    const World world(scene);
    for (const ShadowKind kind : kinds) {
      ShadowOptions options;
      options.kind = kind;
      options.skip_lit = false;
      const Shadows shadows(world, options);
      ShadowCounts counts;
      for (const float x : {0.0f, 0.3f, 3.0f, 8.0f}) {
        const Receiver receiver{{x, 0.1f, 0.2f}, {0, 1, 0}};
        EXPECT_EQ(shadows.visibility(receiver, 0, 3, counts).fraction, 1) << int(kind) << ' ' << x;
      }
    }
  }
}

TEST(LightView, WhatIsBelowTheHorizonIsHidden) {
  Scene scene;
  scene.materials.emplace_back();
  scene.objects.push_back({"far away"});
  scene.spheres.push_back({{0, 90, 90}, 1, 0, 0});
  Light light = light_above(LightType::sphere);
  light.radius = 0.5f;
  scene.lights.push_back(light);
  for (const float height : {0.1f, -0.1f, -0.6f}) {
    scene.lights[0].position = {3, height, 0};
    const bool centre_seen = height > 0;
    EXPECT_EQ(fraction(scene, ShadowKind::hard), centre_seen) << height;
    EXPECT_EQ(fraction(scene, ShadowKind::parker), centre_seen) << height;
    // The disk's part above a chord, x = height / radius.
    const float x = std::clamp(height / 0.5f, -1.0f, 1.0f);
    const float part = 0.5f + (x * std::sqrt(1 - x * x) + std::asin(x)) / pi;
    EXPECT_NEAR(fraction(scene, ShadowKind::area), part, 0.03f) << height;
  }
}

TEST(LightView, WhatIsInsideASphereLightDoesNotOccludeIt) {
  Scene scene;
  scene.materials.emplace_back();
  scene.objects.push_back({"bulb"});
  scene.spheres.push_back({{0, 4, 0}, 0.3f, 0, 0});
  Light light = light_above(LightType::sphere);
  light.radius = 0.5f;
  scene.lights.push_back(light);
  EXPECT_EQ(fraction(scene, ShadowKind::area), 1);
}

}  // namespace
}  // namespace penumbra
