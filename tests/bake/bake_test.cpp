#include "bake/bake.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "bake/bake_scenes.h"
#include "bake/glb_lights.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "base/parallel.h"
#include "scene/load.h"
#include "support/temporary_folder.h"

namespace penumbra::bake {
namespace {

using test::add_cube;
using test::add_quad;
using test::FieldIrradiance;

Vec3 wavy(const Vec3& p) { return Vec3(2 + std::sin(9 * p.x) + std::sin(7 * p.z + 5 * p.y)); }

/// A floor of both sides under a cube.
class BakeTest : public ::testing::Test {
 protected:
  BakeTest() {
    add_cube(scene_);
    add_quad(scene_, {-3, -1, 3}, {6, 0, 0}, {0, 0, -6});
    scene_.materials[1].double_sided = true;
    scene_.cameras.push_back({"view", {0, 2, 9}, {0, 0, 0}, {0, 1, 0}, 0.7f, {}});
    scene_.background = {0.1f, 0.2f, 0.3f};
    textures_.texel_size = 0.1f;
  }

  Baked bake_scene(Output output = Output::radiance, const PageSink& sink = {}) {
    const LightViews views(scene_);
    const DirectLight lights(views);
    const MaterialLookup materials(scene_);
    const FieldIrradiance irradiance(wavy);
    const Plan plan = make_plan(scene_, textures_);
    Progress silent;
    BakeInput input{scene_, irradiance, lights, materials, Vec3(), exposure_};
    if (!source_.materials.empty()) input.source = &source_;
    return bake(input, plan, textures_, output, sink, silent);
  }

  /// Written and read again by the reader of glTF files.
  Scene read_back(const Baked& baked) {
    write_file(folder_ / "baked.glb", glb_bytes(baked.model));
    return load_scene(folder_ / "baked.glb", {.add_missing_camera_and_light = false});
  }

  std::string error_of_plan() {
    try {
      make_plan(scene_, textures_);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  test::TemporaryFolder folder_;
  Scene scene_;
  TextureOptions textures_;
  GltfMaterials source_;
  float exposure_ = -1.5f;
};

TEST_F(BakeTest, RadianceComesBackFromTheFile) {
  textures_.texel_size = 0.03f;
  const Scene back = read_back(bake_scene());
  EXPECT_THAT(back.report.warnings, ::testing::IsEmpty());
  EXPECT_NEAR(back.exposure_ev.value_or(0), -1.5f, 1e-6f);
  EXPECT_EQ(back.background, scene_.background);
  ASSERT_EQ(back.cameras.size(), 1u);
  EXPECT_NEAR(length(back.cameras[0].position - Vec3(0, 2, 9)), 0, 1e-5f);
  EXPECT_TRUE(back.lights.empty());
  const World world(back, {.cone_tree = false});
  const MaterialLookup materials(back);
  // Looking down at the floor beside the cube, up at it from below, and at the cube's front.
  const Ray rays[] = {
      {{2.2f, 5, 1.3f}, {0, -1, 0}}, {{-1.7f, -5, 0.4f}, {0, 1, 0}}, {{0.3f, 0.2f, 5}, {0, 0, -1}}};
  for (const Ray& ray : rays) {
    const auto hit = world.intersect(ray);
    ASSERT_TRUE(hit);
    const Surface surface = world.surface(ray, *hit);
    EXPECT_TRUE(surface.front);
    const Vec3 seen = materials.at(surface, -ray.direction, 0).emission;
    const float expected = 0.8f * wavy(surface.position).x / std::numbers::pi_v<float>;
    // 8 bits at an exposure of −1.5 EV, and linear between texels.
    EXPECT_NEAR(seen.x, expected, 0.03f * expected);
  }
}

TEST_F(BakeTest, BothSidesAreWrittenAndCoordinatesStayWithinTheTexture) {
  const Scene back = read_back(bake_scene());
  std::size_t triangles = 0;
  for (const Instance& instance : back.instances) {
    const Mesh& mesh = back.meshes[instance.mesh];
    EXPECT_GT(back.materials[instance.material].unlit, 0);
    EXPECT_FALSE(back.materials[instance.material].double_sided);
    triangles += mesh.triangle_count();
    for (const Vec2& uv : mesh.uv[0]) {
      EXPECT_GE(std::min(uv.x, uv.y), 0);
      EXPECT_LE(std::max(uv.x, uv.y), 1);
    }
  }
  EXPECT_EQ(triangles, 12u + 2 * 2u);
}

TEST_F(BakeTest, WhatDoesNotReceiveIsLitAtItsVertices) {
  scene_.objects[0].receives = false;
  scene_.lights.emplace_back();
  scene_.lights[0].type = LightType::point;
  scene_.lights[0].position = {0, 9, 0};
  scene_.lights[0].emission = Vec3(100.0f);
  const Scene back = read_back(bake_scene());
  std::size_t colored = 0;
  for (const Mesh& mesh : back.meshes) {
    if (mesh.colors.empty()) continue;
    ++colored;
    EXPECT_EQ(mesh.triangle_count(), 12u);
    for (std::size_t i = 0; i < mesh.colors.size(); ++i) {
      // The top alone faces the light: 0.8 / π · I cos θ / r², 8 m below it.
      const Vec3& p = mesh.positions[i];
      const float r2 = p.x * p.x + 64 + p.z * p.z;
      const float lit = 0.8f / std::numbers::pi_v<float> * 100 * 8 / (r2 * std::sqrt(r2));
      const float shown = mesh.colors[i].x * std::exp2(1.5f);
      EXPECT_TRUE(std::abs(shown - lit) < 1e-3f || shown == 0) << shown << " " << lit;
    }
  }
  EXPECT_EQ(colored, 1u);
}

TEST_F(BakeTest, ALightmapKeepsMaterialsAndSaysWhatItHolds) {
  scene_.materials[0].name = "stone";
  scene_.materials[0].diffuse = {0.25f, 0.5f, 0.75f};
  scene_.lights.emplace_back();
  scene_.lights[0].type = LightType::point;
  scene_.lights[0].emission = Vec3(1.0f);
  std::vector<Image> pages;
  const Baked baked = bake_scene(
      Output::lightmap, [&](int, std::size_t, const Image& image) { pages.push_back(image); });
  ASSERT_EQ(pages.size(), 1u);
  const float most = *std::ranges::max_element(pages[0].data);
  EXPECT_NEAR(most, 4, 0.2f);
  bool found = false;
  for (const Json::Value& material : baked.model.materials) {
    const Json::Value& map = material["extensions"]["MOZ_lightmap"];
    EXPECT_EQ(map["texCoord"].asInt(), 1);
    EXPECT_FLOAT_EQ(map["intensity"].asFloat(), most);
    found |= material["name"] == "stone" &&
             material["pbrMetallicRoughness"]["baseColorFactor"][1].asFloat() == 0.5f;
  }
  EXPECT_TRUE(found);
  EXPECT_EQ(baked.description["meshes"].size(), 2u + 0u);
  EXPECT_FLOAT_EQ(baked.description["images"][0]["intensity"].asFloat(), most);
  const std::string glb = glb_bytes(baked.model);
  EXPECT_THAT(glb, ::testing::HasSubstr("\"baked\":true"));
  const Scene back = read_back(baked);
  EXPECT_EQ(back.lights.size(), 1u);
  for (const Mesh& mesh : back.meshes) EXPECT_EQ(mesh.uv[1].size(), mesh.positions.size());
}

TEST_F(BakeTest, ALightmapLeavesAFilesMaterialsUntouched) {
  source_.materials = {
      R"({"name":"stone","normalTexture":{"index":1,"scale":0.5,"texCoord":1},)"
      R"("occlusionTexture":{"index":0,"strength":0.25},"doubleSided":true,"extras":{"a":1},)"
      R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":)"
      R"({"KHR_texture_transform":{"scale":[2,3],"texCoord":1}}},"metallicFactor":0.125},)"
      R"("extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":1,)"
      R"("clearcoatTexture":{"index":2}},"KHR_materials_sheen":{)"
      R"("sheenColorTexture":{"index":0,"texCoord":2}}}})"};
  source_.textures = {R"({"source":1,"sampler":0})", R"({"source":0})",
                      R"({"source":0,"sampler":1})"};
  source_.samplers = {R"({"magFilter":9728})", R"({"wrapS":33648})"};
  source_.images = {{"bumps", "image/jpeg", "jpeg bytes"}, {"colours", "image/png", "png bytes"}};
  const Baked baked = bake_scene(Output::lightmap);
  const GlbModel& model = baked.model;
  const Json::Value* stone = nullptr;
  for (const Json::Value& material : model.materials)
    if (material["name"] == "stone") stone = &material;
  ASSERT_TRUE(stone);
  const Json::Value& m = *stone;
  EXPECT_EQ(m["normalTexture"]["scale"].asDouble(), 0.5);
  EXPECT_EQ(m["normalTexture"]["texCoord"].asInt(), 2) << "the lightmap has taken TEXCOORD_1";
  EXPECT_EQ(m["occlusionTexture"]["strength"].asDouble(), 0.25);
  EXPECT_FALSE(m["occlusionTexture"].isMember("texCoord"));
  const Json::Value& base = m["pbrMetallicRoughness"]["baseColorTexture"];
  const Json::Value& transform = base["extensions"]["KHR_texture_transform"];
  EXPECT_EQ(transform["scale"][1].asInt(), 3);
  EXPECT_EQ(transform["texCoord"].asInt(), 2);
  EXPECT_EQ(m["pbrMetallicRoughness"]["metallicFactor"].asDouble(), 0.125);
  EXPECT_EQ(m["extras"]["a"].asInt(), 1);
  EXPECT_FALSE(m["extensions"]["KHR_materials_sheen"].isMember("sheenColorTexture"));
  EXPECT_EQ(m["extensions"]["MOZ_lightmap"]["texCoord"].asInt(), 1);
  const auto texture = [&](const Json::Value& use) {
    return model.textures[use["index"].asUInt()];
  };
  const auto image = [&](const Json::Value& use) -> const GlbImage& {
    return model.images[texture(use)["source"].asUInt()];
  };
  const auto sampler = [&](const Json::Value& use) {
    return model.samplers[texture(use)["sampler"].asUInt() - 2];
  };
  EXPECT_EQ(image(m["normalTexture"]).bytes, "jpeg bytes");
  EXPECT_EQ(image(m["normalTexture"]).mime_type, "image/jpeg");
  EXPECT_FALSE(texture(m["normalTexture"]).isMember("sampler"));
  EXPECT_EQ(image(base).name, "colours");
  EXPECT_EQ(sampler(base)["magFilter"].asInt(), 9728);
  EXPECT_EQ(base["index"], m["occlusionTexture"]["index"]);
  const Json::Value& coat = m["extensions"]["KHR_materials_clearcoat"]["clearcoatTexture"];
  EXPECT_EQ(sampler(coat)["wrapS"].asInt(), 33648);
  const std::string glb = glb_bytes(model);
  for (const char* used : {"KHR_texture_transform", "KHR_materials_clearcoat", "MOZ_lightmap"})
    EXPECT_THAT(glb, ::testing::HasSubstr(std::string(R"(")") + used + R"(")"));
}

TEST_F(BakeTest, ALightmapSaysWhatItsLightsWere) {
  Light segment;
  segment.type = LightType::segment;
  segment.name = "tube";
  segment.position = {1, 2, 3};
  segment.edge_u = {2, 0, 0};
  segment.radius = 0.25f;
  segment.emission = {4, 5, 6};
  Light point;
  point.emission = {7, 7, 7};
  scene_.lights = {segment, point};
  Json::Value root;
  std::set<std::string> extensions;
  add_lights(bake_scene(Output::lightmap).model.lights, true, root, extensions);
  ASSERT_EQ(root["nodes"].size(), 2u);
  const Json::Value& tube = root["nodes"][0];
  EXPECT_EQ(tube["name"], "tube");
  EXPECT_FALSE(tube.isMember("extensions"));
  EXPECT_TRUE(tube["extras"]["baked"].asBool());
  EXPECT_EQ(tube["extras"]["light"]["type"], "segment");
  EXPECT_EQ(tube["extras"]["light"]["from"][0].asDouble(), 0);
  EXPECT_EQ(tube["extras"]["light"]["to"][0].asDouble(), 2);
  EXPECT_EQ(tube["extras"]["light"]["radius"].asDouble(), 0.25);
  EXPECT_EQ(tube["extras"]["light"]["radiance"][2].asDouble(), 6);
  const Json::Value& lamp = root["nodes"][1];
  EXPECT_TRUE(lamp["extras"]["baked"].asBool());
  EXPECT_EQ(lamp["extras"]["light"]["type"], "point");
  const Json::Value& listed = root["extensions"]["KHR_lights_punctual"]["lights"];
  ASSERT_EQ(listed.size(), 1u);
  EXPECT_TRUE(listed[0]["extras"]["baked"].asBool());
}

TEST_F(BakeTest, IsTheSameAtAnyNumberOfThreads) {
  const auto bytes = [&](int threads) {
    const ThreadLimit limit(threads);
    return glb_bytes(bake_scene().model);
  };
  EXPECT_EQ(bytes(1), bytes(3));
}

TEST_F(BakeTest, TexelsBeyondAPageAreRefusedWithASizeThatFits) {
  for (const std::uint64_t most : {0, 50'000'000}) {
    textures_.texel_size = 0.0001f;
    textures_.most_bytes = most;
    const std::string error = error_of_plan(), words = "give --texel-size ";
    EXPECT_THAT(error, ::testing::HasSubstr("and a texture holds 4088; " + words));
    textures_.texel_size = std::stof(error.substr(error.find(words) + words.size()));
    EXPECT_EQ(error_of_plan(), "no error") << *textures_.texel_size;
  }
}

TEST_F(BakeTest, TooMuchMemoryIsRefusedWithATexelSizeThatFits) {
  textures_.texel_size = 0.002f;
  textures_.most_bytes = 50'000'000;
  const std::string error = error_of_plan();
  EXPECT_THAT(error, ::testing::StartsWith("--texel-size: texels of 0.002 m need "));
  const std::string words = "give --texel-size ";
  const auto at = error.find(words);
  ASSERT_NE(at, error.npos);
  textures_.texel_size = std::stof(error.substr(at + words.size()));
  EXPECT_EQ(error_of_plan(), "no error");
}

TEST_F(BakeTest, NothingThatReceivesIsRefused) {
  for (Object& object : scene_.objects) object.receives = false;
  EXPECT_EQ(error_of_plan(),
            "no surface receives light: there is nothing to bake; name objects by --receivers, or "
            "let one have \"receives\": true");
  textures_.receivers = {"object 1"};
  EXPECT_EQ(error_of_plan(), "no error");
  textures_.receivers = {"objekt 1"};
  EXPECT_EQ(error_of_plan(),
            "--receivers: there is no object 'objekt 1'; did you mean 'object 1'?");
}

TEST_F(BakeTest, OverlappingCoplanarWallsAreBakedEach) {
  add_quad(scene_, {-3, -1, 3}, {6, 0, 0}, {0, 0, -6});
  const Scene back = read_back(bake_scene());
  std::size_t triangles = 0;
  for (const Mesh& mesh : back.meshes) triangles += mesh.triangle_count();
  EXPECT_EQ(triangles, 12u + 2 * 2u + 2u);
}

}  // namespace
}  // namespace penumbra::bake
