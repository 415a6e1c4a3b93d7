// glTF: lights and cameras.
#include <gmock/gmock.h>

#include <numbers>

#include "scene/gltf_file.h"

namespace penumbra {
namespace {

using std::numbers::pi;
using test::bare;
using test::read;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

void expect_near(const Vec3& a, const Vec3& b) {
  const float tolerance = 1e-5f * std::max(1.0f, length(b));
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

/// A node at (1, 2, 3), turned so that its −Z points down and its +Y to −Z.
const std::string kDown =
    R"("translation":[1,2,3],"rotation":[-0.70710678118654752,0,0,0.70710678118654752])";

Scene with_light(const std::string& extension, const std::string& light,
                 const std::string& node = kDown) {
  return read(
      bare(fmt::format(R"("extensions":{{"{}":{{"lights":[{{{}}}]}}}},)"
                       R"("nodes":[{{"name":"lamp","extensions":{{"{}":{{"light":0}}}}{}{}}}])",
                       extension, light, extension, node.empty() ? "" : ",", node)));
}

Light punctual(const std::string& light, const std::string& node = kDown) {
  return with_light("KHR_lights_punctual", light, node).lights.at(0);
}

Light area(const std::string& light, const std::string& node = kDown) {
  return with_light("EXT_lights_area", light, node).lights.at(0);
}

TEST(GltfLight, PointsHaveAnIntensity) {
  const Light light = punctual(R"("type":"point","color":[1,0.5,0],"intensity":40)");
  EXPECT_EQ(light.type, LightType::point);
  EXPECT_EQ(light.name, "lamp");
  expect_near(light.position, {1, 2, 3});
  expect_near(light.emission, {40, 20, 0});
  EXPECT_EQ(light.spot_cos_outer, -1);
  expect_near(punctual(R"("type":"point","name":"n")").emission, Vec3(1));
  EXPECT_EQ(punctual(R"("type":"point","name":"n")").name, "n");
}

TEST(GltfLight, ARadiusMakesASphereOfTheSameIntensity) {
  const Light light = punctual(R"("type":"point","intensity":40,"extras":{"radius":0.5})");
  EXPECT_EQ(light.type, LightType::sphere);
  EXPECT_FLOAT_EQ(light.radius, 0.5f);
  expect_near(light.emission, Vec3(static_cast<float>(40 / (pi * 0.25))));
}

TEST(GltfLight, TheNodesRadiusComesFirstAndIsScaled) {
  const Light light = punctual(R"("type":"point","intensity":40,"extras":{"radius":0.5})",
                               R"("scale":[3,3,3],"extras":{"radius":2})");
  EXPECT_FLOAT_EQ(light.radius, 6);
  expect_near(light.emission, Vec3(static_cast<float>(40 / (pi * 36))));
}

TEST(GltfLight, ExtrasThatAreNoRadiusAreIgnored) {
  for (const char* extras : {R"({"radius":"big"})", R"({"radius":-1})", R"([1])", R"("x")", "null"})
    EXPECT_EQ(punctual(fmt::format(R"("type":"point","extras":{})", extras)).type, LightType::point)
        << extras;
}

TEST(GltfLight, UnevenScaleIsWarnedOf) {
  const Scene scene = with_light("KHR_lights_punctual", R"("type":"point","extras":{"radius":1})",
                                 R"("scale":[1,2,-4])");
  EXPECT_FLOAT_EQ(scene.lights.at(0).radius, 4);
  EXPECT_THAT(scene.report.warnings, ElementsAre(HasSubstr("largest of its node's scales (lamp)")));
  EXPECT_THAT(
      with_light("KHR_lights_punctual", R"("type":"point")", R"("scale":[1,2,3])").report.warnings,
      IsEmpty());
}

TEST(GltfLight, SpotsKeepTheirConeAsSpheresToo) {
  const std::string spot = R"("type":"spot","spot":{"innerConeAngle":0.25,"outerConeAngle":0.5})";
  for (const std::string& extras : {std::string(), std::string(R"(,"extras":{"radius":1})")}) {
    const Light light = punctual(spot + extras);
    EXPECT_EQ(light.type, extras.empty() ? LightType::point : LightType::sphere);
    expect_near(light.normal, {0, -1, 0});
    EXPECT_FLOAT_EQ(light.spot_cos_inner, std::cos(0.25f));
    EXPECT_FLOAT_EQ(light.spot_cos_outer, std::cos(0.5f));
  }
  const Light plain = punctual(R"("type":"spot")");
  EXPECT_FLOAT_EQ(plain.spot_cos_inner, 1);
  EXPECT_FLOAT_EQ(plain.spot_cos_outer, static_cast<float>(std::cos(pi / 4)));
}

TEST(GltfLight, DirectionalLightsAreSuns) {
  const Light sun = punctual(R"("type":"directional","intensity":100000)");
  EXPECT_EQ(sun.type, LightType::sun);
  expect_near(sun.direction, {0, -1, 0});
  expect_near(sun.emission, Vec3(100000));
  EXPECT_EQ(sun.angular_diameter, 0);
  const Light wide = punctual(R"("type":"directional","extras":{"angular_diameter_deg":90})");
  EXPECT_FLOAT_EQ(wide.angular_diameter, static_cast<float>(pi / 2));
}

TEST(GltfLight, AreaRectangleEmitsAlongMinusZ) {
  const Light light =
      area(R"("type":"rect","color":[1,0.5,0],"intensity":200,"size":2,"rect":{"aspect":3})");
  EXPECT_EQ(light.type, LightType::rect);
  expect_near(light.position, {1, 2, 3});
  expect_near(light.normal, {0, -1, 0});
  expect_near(light.edge_u, {-6, 0, 0});
  expect_near(light.edge_v, {0, 0, -2});
  expect_near(normalize(cross(light.edge_u, light.edge_v)), light.normal);
  expect_near(light.emission, {200, 100, 0});
}

TEST(GltfLight, AreaDiskHasADiameter) {
  const Light light = area(R"("type":"disk","size":3)", R"("scale":[2,2,2])");
  EXPECT_EQ(light.type, LightType::disk);
  EXPECT_FLOAT_EQ(light.radius, 3);
  expect_near(light.normal, {0, 0, -1});
  expect_near(light.emission, Vec3(1000));
}

TEST(GltfLight, AreaLightsAreReadLeniently) {
  EXPECT_EQ(area("").type, LightType::rect);
  EXPECT_EQ(area(R"("shape":"disk")").type, LightType::disk);
  expect_near(area(R"("aspect":2)", "").edge_u, {-2, 0, 0});
  expect_near(area(R"("intensity":3000000000)").emission, Vec3(3e9f));
}

TEST(GltfLight, ASingularTransformLeavesTheLightOut) {
  const Scene scene = with_light("KHR_lights_punctual", R"("type":"point")", R"("scale":[0,0,0])");
  EXPECT_THAT(scene.lights, IsEmpty());
  EXPECT_THAT(scene.report.warnings,
              ElementsAre("a light with a singular transform is left out (lamp)"));
}

TEST(GltfLight, OnlyNodesOfTheSceneShine) {
  const Scene scene = read(
      bare(R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}},"scenes":[{}],)"
           R"("nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}}])"));
  EXPECT_THAT(scene.lights, IsEmpty());
}

Scene with_camera(const std::string& camera, const std::string& node = kDown) {
  return read(bare(
      fmt::format(R"("cameras":[{{{}}}],"nodes":[{{"name":"eye","camera":0,{}}}])", camera, node)));
}

TEST(GltfCamera, PerspectiveLooksAlongMinusZ) {
  const Camera camera =
      with_camera(R"("type":"perspective","perspective":{"yfov":0.5,"znear":0.1})").cameras.at(0);
  EXPECT_EQ(camera.name, "eye");
  expect_near(camera.position, {1, 2, 3});
  expect_near(normalize(camera.look_at - camera.position), {0, -1, 0});
  expect_near(camera.up, {0, 0, -1});
  EXPECT_FLOAT_EQ(camera.vertical_fov, 0.5f);
  EXPECT_FALSE(camera.ortho_height);
}

TEST(GltfCamera, OrthographicHasAHeight) {
  const Camera camera = with_camera(R"("name":"top","type":"orthographic","orthographic":)"
                                    R"({"xmag":2,"ymag":1.5,"znear":0,"zfar":10})",
                                    R"("scale":[2,2,2])")
                            .cameras.at(0);
  EXPECT_EQ(camera.name, "top");
  EXPECT_FLOAT_EQ(camera.ortho_height.value(), 3);
  expect_near(camera.look_at, {0, 0, -1});
}

TEST(GltfCamera, ASingularTransformLeavesTheCameraOut) {
  const Scene scene = with_camera(R"("type":"perspective","perspective":{"yfov":0.5,"znear":0.1})",
                                  R"("scale":[1,1,0])");
  EXPECT_THAT(scene.cameras, IsEmpty());
  EXPECT_THAT(scene.report.warnings, ElementsAre(HasSubstr("(eye)")));
}

}  // namespace
}  // namespace penumbra
