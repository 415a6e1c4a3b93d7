// glTF: what baked files say, unlit surfaces, vertex colours and receivers.
#include <gmock/gmock.h>

#include "base/error.h"
#include "scene/finish.h"
#include "scene/gltf_file.h"

namespace penumbra {
namespace {

using test::read;
using test::triangle_with;

const std::string unlit =
    R"("extensionsUsed":["KHR_materials_unlit"],"materials":[{"emissiveFactor":[1,1,1],)"
    R"("extensions":{"KHR_materials_unlit":{}}}])";

Scene unlit_scene() { return read(triangle_with(unlit, R"(,"material":0)")); }

TEST(GltfBaked, UnlitSurfacesShowTheirBaseColour) {
  const Scene scene = unlit_scene();
  EXPECT_EQ(scene.materials.at(0).unlit, 1);
  EXPECT_EQ(scene.materials.at(0).emission, Vec3{});
  EXPECT_THAT(scene.report.warnings, testing::IsEmpty());
  EXPECT_FALSE(scene.exposure_ev);
}

TEST(GltfBaked, NoLightIsAddedToWhatNeedsNone) {
  Scene scene = unlit_scene();
  finish_scene(scene, "a.gltf");
  add_missing_camera_and_light(scene);
  EXPECT_EQ(scene.cameras.size(), 1u);
  EXPECT_TRUE(scene.lights.empty());
}

/// With what `penumbra bake` writes into asset.extras.
std::string with_display(const std::string& members) {
  std::string text = triangle_with(unlit, R"(,"material":0)");
  const std::string version = R"("version":"2.0")";
  return text.replace(text.find(version), version.size(),
                      version + R"(,"extras":{"penumbra":{)" + members + "}}");
}

TEST(GltfBaked, TheExposureIsTakenBackAndKept) {
  const Scene scene = read(with_display(R"("exposure_ev":-2,"background":[0.5,1,2])"));
  EXPECT_EQ(scene.materials.at(0).unlit, 4);
  EXPECT_EQ(scene.exposure_ev, -2.0f);
  EXPECT_EQ(scene.background, Vec3(0.5f, 1, 2));
}

TEST(GltfBaked, NonsenseInExtrasIsLeftOut) {
  for (const char* text : {R"("exposure_ev":1e9,"background":[1,2])",
                           R"("exposure_ev":"x","background":[-1,0,0])", R"("exposure_ev":{})"}) {
    const Scene scene = read(with_display(text));
    EXPECT_EQ(scene.materials.at(0).unlit, 1);
    EXPECT_FALSE(scene.exposure_ev);
    EXPECT_EQ(scene.background, Vec3{});
  }
}

TEST(GltfBaked, ReadsVertexColours) {
  test::GltfFile file;
  const int positions = file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int colors = file.accessor(
      file.view(std::vector<std::uint16_t>{65535, 0, 0, 65535, 0, 65535, 0, 65535, 0, 0, 13107, 0}),
      5123, "VEC4", 3, R"(,"normalized":true)");
  const Scene scene =
      read(file.text(test::one_node(R"({"attributes":{"POSITION":)" + std::to_string(positions) +
                                    R"(,"COLOR_0":)" + std::to_string(colors) + "}}")));
  EXPECT_THAT(scene.meshes.at(0).colors,
              testing::ElementsAre(Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 0.2f)));
}

TEST(GltfBaked, NodesSayWhetherTheyReceive) {
  std::string text = triangle_with("");
  const std::string node = R"({"mesh":0)";
  EXPECT_TRUE(read(text).objects.at(0).receives);
  text.replace(text.find(node), node.size(), node + R"(,"extras":{"receives":false})");
  EXPECT_FALSE(read(text).objects.at(0).receives);
  EXPECT_EQ(read(text).objects.at(0).samples_scale, 1);
}

TEST(GltfBaked, NodesSayHowManySamplesTheyTake) {
  const std::string node = R"({"mesh":0)";
  const auto with = [&](const std::string& scale) {
    std::string text = triangle_with("");
    return text.replace(text.find(node), node.size(),
                        node + R"(,"extras":{"samples_scale":)" + scale + "}");
  };
  EXPECT_EQ(read(with("2.5")).objects.at(0).samples_scale, 2.5f);
  for (const auto& [scale, what] :
       {std::pair{"0", "it is 0"}, std::pair{"\"two\"", "it is no number"},
        std::pair{"1e4", "it is 10000"}}) {
    try {
      read(with(scale));
      ADD_FAILURE() << scale;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(std::string("nodes[0].extras.samples_scale: ") +
                                                   what + "; give a number from 0.001 to 1000"));
    }
  }
}

TEST(GltfBaked, MaterialsOfSceneFilesComeBack) {
  const auto with = [](const std::string& roughness) {
    return triangle_with(R"("materials":[{"extras":{"penumbra":{"diffuse":[0.1,0.2,0.3],)"
                         R"("specular":[0.04,0.05,0.06],"mirror":[0,0.5,1],"roughness":)" +
                             roughness + "}}}]",
                         R"(,"material":0)");
  };
  const Material own = read(with("0.25")).materials.at(0);
  EXPECT_FALSE(own.is_metallic_roughness);
  EXPECT_EQ(own.diffuse, Vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(own.specular, Vec3(0.04f, 0.05f, 0.06f));
  EXPECT_EQ(own.mirror, Vec3(0, 0.5f, 1));
  EXPECT_EQ(own.roughness, 0.25f);
  EXPECT_TRUE(read(with("7")).materials.at(0).is_metallic_roughness);
}

TEST(GltfBaked, StoredVisibilityComesWithItsAmbientLight) {
  EXPECT_FALSE(read(triangle_with("")).stores_visibility);
  const Scene scene = read(with_display(R"("ambient":[0.1,0.2,0.3],"store":{})"));
  EXPECT_TRUE(scene.stores_visibility);
  EXPECT_EQ(scene.ambient, Vec3(0.1f, 0.2f, 0.3f));
  EXPECT_FALSE(read(with_display(R"("store":3)")).stores_visibility);
}

}  // namespace
}  // namespace penumbra
