// glTF: materials and textures.
#include <gmock/gmock.h>

#include "scene/gltf/mirror.h"
#include "scene/gltf/uri.h"
#include "scene/gltf_file.h"
#include "scene/gltf_materials.h"
#include "scene/load.h"
#include "support/temporary_folder.h"

namespace penumbra {
namespace {

using test::read;
using test::triangle_with;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Material material(const std::string& members) {
  return read(triangle_with(R"("materials":[{)" + members + "}]", R"(,"material":0)"))
      .materials.at(0);
}

/// A BMP of one red pixel.
std::string red_pixel() {
  std::string bmp("BM\x3a\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\1\0\0\0\1\0\0\0\1\0\x18\0", 30);
  bmp.resize(54, '\0');
  return bmp + std::string("\0\0\xff\0", 4);
}

std::string image_uri(const std::string& bytes) {
  return R"({"name":"red","uri":"data:image/bmp;base64,)" + test::base64(bytes) + R"("})";
}

/// A scene whose only material has a base colour texture.
std::string textured(const std::string& images, const std::string& use = "",
                     const std::string& samplers = "") {
  return triangle_with(R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0)" +
                           use + R"(}}}],"textures":[{"source":0)" +
                           (samplers.empty() ? "" : R"(,"sampler":0)") + R"(}],"images":[)" +
                           images + "]" + samplers,
                       R"(,"material":0)");
}

TEST(GltfMaterial, HasTheDefaultsOfTheStandard) {
  const Material m = material(R"("name":"plain")");
  EXPECT_EQ(m.name, "plain");
  EXPECT_TRUE(m.is_metallic_roughness);
  EXPECT_EQ(m.diffuse, Vec3(1));
  EXPECT_EQ(m.metallic, 1);
  EXPECT_EQ(m.roughness, 1);
  EXPECT_EQ(m.alpha, 1);
  EXPECT_FALSE(m.double_sided);
  EXPECT_FALSE(m.alpha_cutoff);
  EXPECT_EQ(m.emission, Vec3{});
  EXPECT_EQ(m.mirror, Vec3{});
  EXPECT_FALSE(m.diffuse_map.used());
}

TEST(GltfMaterial, ReadsFactorsAndClampsThem) {
  const Material m =
      material(R"("doubleSided":true,"pbrMetallicRoughness":{"baseColorFactor":[0.5,2,-1,0.25],)"
               R"("metallicFactor":0.25,"roughnessFactor":0.75})");
  EXPECT_EQ(m.diffuse, (Vec3{0.5f, 1, 0}));
  EXPECT_EQ(m.alpha, 0.25f);
  EXPECT_EQ(m.metallic, 0.25f);
  EXPECT_EQ(m.roughness, 0.75f);
  EXPECT_TRUE(m.double_sided);
}

TEST(GltfMaterial, EmissionIsFactorTimesStrength) {
  EXPECT_EQ(material(R"("emissiveFactor":[1,0.5,0])").emission, (Vec3{1, 0.5f, 0}));
  EXPECT_EQ(material(R"("emissiveFactor":[1,0.5,0],"extensions":)"
                     R"({"KHR_materials_emissive_strength":{"emissiveStrength":5000000000}})")
                .emission,
            (Vec3{5e9f, 2.5e9f, 0}));
}

TEST(GltfMaterial, MaskHasACutoff) {
  EXPECT_EQ(material(R"("alphaMode":"MASK")").alpha_cutoff, 0.5f);
  EXPECT_EQ(material(R"("alphaMode":"MASK","alphaCutoff":0.25)").alpha_cutoff, 0.25f);
}

TEST(GltfMaterial, AMaskWithoutTextureShowsAllOrNothing) {
  const auto instances = [](const char* alpha, const char* mode) {
    const Scene scene =
        read(triangle_with(fmt::format(R"("materials":[{{"alphaMode":"{}","pbrMetallicRoughness":)"
                                       R"({{"baseColorFactor":[1,1,1,{}]}}}}])",
                                       mode, alpha),
                           R"(,"material":0)"));
    EXPECT_EQ(scene.report.warnings.size(), scene.instances.empty() ? 1u : 0u);
    return scene.instances.size();
  };
  EXPECT_EQ(instances("0.25", "MASK"), 0u);
  EXPECT_EQ(instances("0.5", "MASK"), 1u);
  EXPECT_EQ(instances("0.25", "OPAQUE"), 1u);
}

TEST(GltfMaterial, BlendIsOpaqueWithAWarning) {
  const Scene scene = read(triangle_with(
      R"("materials":[{"name":"leaf","alphaMode":"BLEND"},{"name":"glass","alphaMode":"BLEND",)"
      R"("pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.2]}}])"));
  EXPECT_FALSE(scene.materials.at(0).alpha_cutoff);
  EXPECT_THAT(scene.report.warnings,
              ElementsAre("alphaMode BLEND is shown opaque (leaf)",
                          "alphaMode BLEND is shown opaque though alpha is below 0.5 (glass)"));
}

TEST(GltfMaterial, SmoothMetalsAreMirrors) {
  EXPECT_EQ(gltf::mirror_of_metal({0.8f, 0.4f, 0.2f}, 1, 0), (Vec3{0.8f, 0.4f, 0.2f}));
  EXPECT_NEAR(gltf::mirror_of_metal(Vec3(1), 0.5f, 0.075f).x, 0.25f, 1e-6);
  EXPECT_EQ(gltf::mirror_of_metal(Vec3(1), 1, 0.15f), Vec3{});
  EXPECT_EQ(gltf::mirror_of_metal(Vec3(1), 0.49f, 0), Vec3{});
  EXPECT_EQ(material(R"("pbrMetallicRoughness":{"roughnessFactor":0})").mirror, Vec3(1));
}

TEST(GltfMaterial, MeshesWithoutAMaterialAreMatteGrey) {
  const Scene scene = read(triangle_with(R"("materials":[{}])"));
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.instances.at(0).material, 1u);
  EXPECT_EQ(scene.materials[1].metallic, 0);
  EXPECT_THAT(scene.report.conversions, ElementsAre(HasSubstr("without a material")));
}

TEST(GltfTexture, DecodesEmbeddedImages) {
  const Scene scene = read(textured(image_uri(red_pixel())));
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.textures[0].name, "red");
  EXPECT_THAT(scene.textures[0].rgba, ElementsAre(255, 0, 0, 255));
  const TextureSlot& slot = scene.materials.at(0).diffuse_map;
  EXPECT_EQ(slot.image, 0);
  EXPECT_EQ(slot.uv_set, 0);
  EXPECT_EQ(slot.wrap_s, Wrap::repeat);
  EXPECT_FALSE(slot.nearest);
  EXPECT_THAT(scene.report.warnings, IsEmpty());
}

TEST(GltfTexture, DecodesImagesInTheBinaryChunk) {
  test::GltfFile file;
  file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int view = file.view(red_pixel());
  const Scene scene =
      read(file.binary(test::one_node(R"({"attributes":{"POSITION":0},"material":0})") +
                       fmt::format(R"(,"materials":[{{"emissiveTexture":{{"index":0}}}}],)"
                                   R"("textures":[{{"source":0}}],)"
                                   R"("images":[{{"bufferView":{},"mimeType":"image/bmp"}}])",
                                   view)),
           "a.glb");
  EXPECT_THAT(scene.textures.at(0).rgba, ElementsAre(255, 0, 0, 255));
  EXPECT_EQ(scene.materials.at(0).emission_map.image, 0);
}

TEST(GltfTexture, OfEmissionLightsWhereAStrengthIsGiven) {
  for (const bool strong : {false, true}) {
    test::GltfFile file;
    file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    const int view = file.view(red_pixel());
    const char* strength =
        R"("extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4}},)";
    const Scene scene =
        read(file.binary(test::one_node(R"({"attributes":{"POSITION":0},"material":0})") +
                         fmt::format(R"(,"materials":[{{{}"emissiveFactor":[1,1,1],)"
                                     R"("emissiveTexture":{{"index":0}}}}],)"
                                     R"("textures":[{{"source":0}}],)"
                                     R"("images":[{{"bufferView":{},"mimeType":"image/bmp"}}])",
                                     strong ? strength : "", view)),
             "a.glb");
    EXPECT_EQ(scene.materials.at(0).emission_map_lights, strong);
  }
}

TEST(GltfMaterials, AreGivenAsTheFileHasThem) {
  const test::TemporaryFolder folder;
  test::write(folder / "a.bmp", red_pixel());
  test::write(
      folder / "a.gltf",
      R"({"asset":{"version":"2.0"},"materials":[{"name":"m","normalTexture":{"index":0,)"
      R"("scale":0.5}}],"textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33071}],)"
      R"("images":[{"uri":"a.bmp","name":"i","mimeType":"image/bmp"},{"uri":"no.png"}]})");
  const GltfMaterials found = read_gltf_materials(folder / "a.gltf");
  ASSERT_EQ(found.materials.size(), 1u);
  EXPECT_THAT(found.materials[0], ::testing::HasSubstr(R"("scale":0.5)"));
  EXPECT_THAT(found.textures, ElementsAre(R"({"sampler":0,"source":0})"));
  EXPECT_THAT(found.samplers, ElementsAre(R"({"wrapS":33071})"));
  ASSERT_EQ(found.images.size(), 2u);
  EXPECT_EQ(found.images[0].bytes, red_pixel());
  EXPECT_EQ(found.images[0].mime_type, "image/bmp");
  EXPECT_TRUE(found.images[1].bytes.empty());
}

TEST(GltfTexture, ReadsFilesBesideTheDocument) {
  const test::TemporaryFolder folder;
  test::write(folder / "a + b.bmp", red_pixel());
  test::write(folder / "tri.bin", std::string(36, '\0') + "more than is asked for");
  test::write(folder / "a.gltf",
              R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"tri.bin"}],)"
              R"("bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,)"
              R"("componentType":5126,"count":3,"type":"VEC3"}],"materials":[{)"
              R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
              R"("textures":[{"source":0}],"images":[{"uri":"a%20+%20b.bmp"}],)" +
                  test::one_node(R"({"attributes":{"POSITION":0},"material":0})") + "}");
  const Scene scene = read_gltf(folder / "a.gltf");
  EXPECT_EQ(scene.meshes.at(0).positions.size(), 3u);
  EXPECT_THAT(scene.textures.at(0).rgba, ElementsAre(255, 0, 0, 255));
}

TEST(GltfTexture, ImagesThatCannotBeDecodedAreWhite) {
  for (const std::string& image :
       {image_uri("rubbish"), std::string(R"({"uri":"data:image/png;base64,!!!"})"),
        std::string(R"({"uri":"nowhere.png"})"), std::string(R"({"uri":"https://a/b.png"})"),
        std::string(R"({"uri":"/dev/zero"})"), std::string("{}")}) {
    const Scene scene = read(textured(image));
    EXPECT_THAT(scene.textures.at(0).rgba, ElementsAre(255, 255, 255, 255)) << image;
    EXPECT_THAT(scene.report.warnings, ElementsAre(HasSubstr("is shown white (images[0])")));
  }
}

TEST(GltfTexture, DecodesOnlyWhatMaterialsUse) {
  const Scene scene = read(
      textured(image_uri(red_pixel()) + R"(,{"uri":"nowhere.png"})", "", R"(,"samplers":[{}])"));
  EXPECT_EQ(scene.textures.size(), 1u);
  EXPECT_THAT(scene.report.warnings, IsEmpty());
}

TEST(GltfTexture, ReadsSamplers) {
  const TextureSlot slot =
      read(textured(image_uri(red_pixel()), "",
                    R"(,"samplers":[{"wrapS":33071,"wrapT":33648,"magFilter":9728}])"))
          .materials.at(0)
          .diffuse_map;
  EXPECT_EQ(slot.wrap_s, Wrap::clamp);
  EXPECT_EQ(slot.wrap_t, Wrap::mirror);
  EXPECT_TRUE(slot.nearest);
}

TEST(GltfTexture, ReadsTransforms) {
  const TextureSlot slot =
      read(textured(image_uri(red_pixel()),
                    R"(,"texCoord":0,"extensions":{"KHR_texture_transform":{"offset":[0.5,1],)"
                    R"("rotation":0.25,"scale":[2,-3],"texCoord":1}})"))
          .materials.at(0)
          .diffuse_map;
  EXPECT_EQ(slot.offset.x, 0.5f);
  EXPECT_EQ(slot.offset.y, 1);
  EXPECT_EQ(slot.scale.x, 2);
  EXPECT_EQ(slot.scale.y, -3);
  EXPECT_EQ(slot.rotation, 0.25f);
  EXPECT_EQ(slot.uv_set, 1);
}

TEST(GltfTexture, LeavesOutFurtherSetsOfCoordinates) {
  const Scene scene = read(textured(image_uri(red_pixel()), R"(,"texCoord":2)"));
  EXPECT_FALSE(scene.materials.at(0).diffuse_map.used());
  EXPECT_THAT(scene.report.warnings, ElementsAre(HasSubstr("TEXCOORD_2")));
}

TEST(GltfUri, DecodesBase64OfAnyLength) {
  for (const std::string bytes : {"", "a", "ab", "abc", "abcd", "\xff\xfe\xfd"})
    EXPECT_EQ(gltf::decode_data_uri("data:x/y;base64," + test::base64(bytes)), bytes);
  EXPECT_EQ(gltf::decode_data_uri("DATA:;base64,QQ"), "A");
  EXPECT_EQ(gltf::decode_data_uri("data:,a%20b%"), "a b%");
  EXPECT_FALSE(gltf::decode_data_uri("data:;base64,QUJDR"));
  EXPECT_FALSE(gltf::decode_data_uri("data:;base64,Q Q="));
  EXPECT_FALSE(gltf::decode_data_uri("data:QQ"));
}

}  // namespace
}  // namespace penumbra
