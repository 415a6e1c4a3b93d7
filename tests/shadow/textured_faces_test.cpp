// The parts of a light with a texture.
#include "shadow/textured_faces.h"

#include <gtest/gtest.h>

#include <random>

#include "image/srgb.h"

namespace penumbra {
namespace {

/// A quad of 2 m × 1 m, texture coordinates as seen.
Scene window(int width, int height, const std::vector<std::uint8_t>& rgb, bool nearest) {
  Scene scene;
  TextureImage image;
  image.width = width, image.height = height;
  for (std::size_t i = 0; i < rgb.size(); i += 3)
    image.rgba.insert(image.rgba.end(), {rgb[i], rgb[i + 1], rgb[i + 2], 255});
  scene.textures = {image};
  Material& material = scene.materials.emplace_back();
  material.emission = Vec3(1);
  material.emission_map.image = 0;
  material.emission_map.wrap_s = material.emission_map.wrap_t = Wrap::clamp;
  material.emission_map.nearest = nearest;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  mesh.uv[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  scene.meshes = {mesh};
  scene.instances.push_back({0, 0, 0, 0, {}});
  for (int c = 0; c < 3; ++c) {
    Light& light = scene.lights.emplace_back();
    light.type = LightType::mesh, light.instance = 0;
    light.emission[c] = 5;
  }
  return scene;
}

float area_of(const std::vector<LightFace>& faces) {
  float sum = 0;
  for (const LightFace& f : faces) sum += f.area;
  return sum;
}

TEST(TexturedFaces, AreThePanesOfTheirColour) {
  const Scene scene = window(2, 1, {255, 0, 0, 0, 0, 255}, true);
  const auto red = textured_faces(scene, scene.lights[0]);
  const auto green = textured_faces(scene, scene.lights[1]);
  const auto blue = textured_faces(scene, scene.lights[2]);
  EXPECT_NEAR(area_of(red), 1, 1e-6f);
  EXPECT_TRUE(green.empty());
  EXPECT_NEAR(area_of(blue), 1, 1e-6f);
  EXPECT_LE(red.size(), 16u);
  for (const LightFace& f : red)
    for (const Vec3& p : {f.a, f.b, f.c}) EXPECT_LE(p.x, 1 + 1e-6f);
  for (const LightFace& f : blue) {
    EXPECT_EQ(f.brightness, 1);
    EXPECT_GT(f.normal.z, 0.999f);
    for (const Vec3& p : {f.a, f.b, f.c}) EXPECT_GE(p.x, 1 - 1e-6f);
  }
}

TEST(TexturedFaces, AnEvenTextureIsTheMeshItself) {
  const Scene scene = window(4, 4, std::vector<std::uint8_t>(48, 188), false);
  const auto faces = textured_faces(scene, scene.lights[0]);
  ASSERT_EQ(faces.size(), 2u);
  EXPECT_NEAR(faces[0].brightness, linear_from_srgb(188 / 255.0), 1e-4);
  EXPECT_NEAR(area_of(faces), 2 * linear_from_srgb(188 / 255.0), 1e-4);
}

TEST(TexturedFaces, TogetherAreAsBrightAsTheTexture) {
  std::mt19937 random(3);
  std::vector<std::uint8_t> rgb(3 * 32 * 32);
  for (std::uint8_t& x : rgb) x = static_cast<std::uint8_t>(random() % 256);
  const Scene scene = window(32, 32, rgb, false);
  for (int c = 0; c < 3; ++c) {
    double mean = 0;
    for (std::size_t i = static_cast<std::size_t>(c); i < rgb.size(); i += 3)
      mean += linear_from_srgb(rgb[i] / 255.0) / (32 * 32);
    EXPECT_NEAR(area_of(textured_faces(scene, scene.lights[static_cast<std::size_t>(c)])), 2 * mean,
                0.01 * 2 * mean);
  }
}

TEST(TexturedFaces, MeshLightsHaveThem) {
  const Scene scene = window(2, 1, {255, 0, 0, 0, 0, 255}, true);
  const MeshLight red(scene, scene.lights[0]);
  EXPECT_TRUE(red.is_textured);
  EXPECT_TRUE(red.flat);
  EXPECT_NEAR(red.areas.back(), 1, 1e-6f);
  EXPECT_NEAR(length(red.center - Vec3(0.5f, 0.5f, 0)), 0, 1e-5f);
}

}  // namespace
}  // namespace penumbra
