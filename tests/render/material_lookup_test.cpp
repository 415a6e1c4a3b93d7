#include "render/material_lookup.h"

#include <gtest/gtest.h>

namespace penumbra {
namespace {

Surface facing_up() {
  Surface surface;
  surface.normal = surface.shading_normal = {0, 1, 0};
  surface.uv_per_metre = {1, 1};
  return surface;
}

TextureImage checkerboard(int size) {
  TextureImage image;
  image.width = image.height = size;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (int c = 0; c < 4; ++c)
        image.rgba.push_back(c == 3 || (x + y) % 2 == 0 ? std::uint8_t{255} : std::uint8_t{0});
  return image;
}

TEST(MaterialLookup, MetalsReflectTheirColourAndDielectricsFourPercent) {
  Scene scene;
  Material m;
  m.is_metallic_roughness = true;
  m.diffuse = {1, 0.5f, 0.25f};
  m.roughness = 0.5f;
  for (float metallic : {0.0f, 1.0f}) {
    m.metallic = metallic;
    scene.materials.push_back(m);
  }
  const MaterialLookup materials(scene);
  Surface surface = facing_up();
  const ShadingPoint plastic = materials.at(surface, {0, 1, 0}, 0);
  EXPECT_FLOAT_EQ(plastic.diffuse.y, 0.5f * 0.96f);
  EXPECT_FLOAT_EQ(plastic.specular.x, 0.04f);
  EXPECT_FLOAT_EQ(plastic.alpha, 0.25f);
  surface.material = 1;
  const ShadingPoint metal = materials.at(surface, {0, 1, 0}, 0);
  EXPECT_EQ(metal.diffuse, Vec3{});
  EXPECT_FLOAT_EQ(metal.specular.z, 0.25f);
}

TEST(MaterialLookup, TexturesAreFilteredOverThePixel) {
  Scene scene;
  scene.textures.push_back(checkerboard(64));
  Material m;
  m.diffuse = Vec3(1.0f);
  m.diffuse_map.image = 0;
  scene.materials.push_back(m);
  const MaterialLookup materials(scene);
  Surface surface = facing_up();
  surface.uv[0] = {0.5f / 64, 0.5f / 64};
  EXPECT_NEAR(materials.at(surface, {0, 1, 0}, 0).diffuse.x, 1, 1e-3f);
  EXPECT_NEAR(materials.at(surface, {0, 1, 0}, 0.25f).diffuse.x, 0.5f, 0.02f);
}

TEST(MaterialLookup, SingleSidedSurfacesEmitFromTheirFront) {
  Scene scene;
  Material m;
  m.emission = Vec3(2.0f);
  for (bool both : {false, true}) {
    m.double_sided = both;
    scene.materials.push_back(m);
  }
  const MaterialLookup materials(scene);
  Surface surface = facing_up();
  EXPECT_EQ(materials.at(surface, {0, 1, 0}, 0).emission.x, 2);
  surface.front = false;
  EXPECT_EQ(materials.at(surface, {0, 1, 0}, 0).emission.x, 0);
  EXPECT_EQ(materials.at(surface, {0, 1, 0}, 0).diffuse, m.diffuse) << "but reflect from both";
  surface.material = 1;
  EXPECT_EQ(materials.at(surface, {0, 1, 0}, 0).emission.x, 2);
}

}  // namespace
}  // namespace penumbra
