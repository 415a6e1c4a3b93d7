// What the reader makes of right scenes, by value.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "json_support.h"
#include "scene/finish.h"
#include "scene/starter.h"

namespace penumbra::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr float degree = std::numbers::pi_v<float> / 180;

void expect_near(const Vec3& a, const Vec3& b) {
  EXPECT_NEAR(length(a - b), 0, 1e-6f) << a.x << " " << a.y << " " << a.z;
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3 a = mesh.positions[mesh.indices[i]];
    sum += 0.5 * length(cross(mesh.positions[mesh.indices[i + 1]] - a,
                              mesh.positions[mesh.indices[i + 2]] - a));
  }
  return sum;
}

// The sum over triangles of twice their signed volumes with the origin, thrice.
double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    sum += dot(Vec3d(mesh.positions[mesh.indices[i]]),
               cross(Vec3d(mesh.positions[mesh.indices[i + 1]]),
                     Vec3d(mesh.positions[mesh.indices[i + 2]]))) /
           6;
  return sum;
}

// A picture of 2 x 1 pixels, red and green, 24 bits uncompressed.
std::string bmp_file() {
  std::string b(54 + 8, '\0');
  b[0] = 'B', b[1] = 'M', b[2] = 62, b[10] = 54, b[14] = 40, b[18] = 2, b[22] = 1, b[26] = 1;
  b[28] = 24;
  b[56] = static_cast<char>(255), b[58] = static_cast<char>(255);
  return b;
}

TEST(JsonScene, RootDefaults) {
  const Scene scene = read_text(R"({"objects": []})");
  expect_near(scene.ambient, Vec3(0.05f));
  expect_near(scene.background, Vec3(0));
  EXPECT_TRUE(scene.cameras.empty() && scene.lights.empty() && scene.materials.empty());
  EXPECT_EQ(scene.report.format, "Penumbra scene (JSON)");
}

TEST(JsonScene, RootValues) {
  const Scene scene = read_text(
      R"({"$schema": "scene.schema.json", "objects": [], "ambient": [0, 1, 2], "background": [3, 4.5, 6e-1]})");
  expect_near(scene.ambient, Vec3(0, 1, 2));
  expect_near(scene.background, Vec3(3, 4.5f, 0.6f));
}

TEST(JsonScene, Camera) {
  const Scene scene = read_text(with_camera(
      R"({"position": [1, 2, 3], "look_at": [4, 5, 6], "up": [0, 0, 2], "vertical_fov_deg": 60})"));
  ASSERT_EQ(scene.cameras.size(), 1u);
  const Camera& camera = scene.cameras[0];
  EXPECT_EQ(camera.name, "camera");
  expect_near(camera.position, Vec3(1, 2, 3));
  expect_near(camera.look_at, Vec3(4, 5, 6));
  expect_near(camera.up, Vec3(0, 0, 2));
  EXPECT_NEAR(camera.vertical_fov, 60 * degree, 1e-6f);
}

TEST(JsonScene, CamerasKeepTheOrderOfTheFile) {
  const Scene scene = read_text(R"({"objects": [], "cameras": {
      "side": {"position": [1, 0, 0], "look_at": [0, 0, 0]},
      "back": {"position": [0, 0, -1], "look_at": [0, 0, 0]}}})");
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[0].name, "side");
  EXPECT_EQ(scene.cameras[1].name, "back");
  EXPECT_NEAR(scene.cameras[0].vertical_fov, 40 * degree, 1e-6f);
  expect_near(scene.cameras[0].up, Vec3(0, 1, 0));
}

TEST(JsonScene, MaterialDefaults) {
  const Scene scene = read_text(with_material("{}"));
  const Material& m = scene.materials.at(0);
  EXPECT_EQ(m.name, "m");
  expect_near(m.diffuse, Vec3(0.8f));
  expect_near(m.specular, Vec3(0));
  expect_near(m.mirror, Vec3(0));
  expect_near(m.emission, Vec3(0));
  EXPECT_FLOAT_EQ(m.roughness, 0.5f);
  EXPECT_FALSE(m.diffuse_map.used());
  EXPECT_TRUE(m.double_sided);
}

TEST(JsonScene, MaterialValues) {
  const Scene scene = read_text(with_material(
      R"({"diffuse": [0, 0.5, 1], "specular": [0.1, 0.2, 0.3], "roughness": 0.25,
          "mirror": [0.4, 0.5, 0.6], "emission": [7, 8, 9]})"));
  const Material& m = scene.materials.at(0);
  expect_near(m.diffuse, Vec3(0, 0.5f, 1));
  expect_near(m.specular, Vec3(0.1f, 0.2f, 0.3f));
  expect_near(m.mirror, Vec3(0.4f, 0.5f, 0.6f));
  expect_near(m.emission, Vec3(7, 8, 9));
  EXPECT_FLOAT_EQ(m.roughness, 0.25f);
}

TEST(JsonScene, MirrorAsNumber) {
  expect_near(read_text(with_material(R"({"mirror": 0.9})")).materials[0].mirror, Vec3(0.9f));
}

TEST(JsonScene, TextureIsReadOnceForTwoMaterials) {
  write_file(scratch().file("two.bmp"), bmp_file());
  const Scene scene = read_text(R"({"objects": [], "materials": {
      "a": {"texture": "two.bmp"}, "b": {"texture": "two.bmp"}}})");
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.textures[0].name, "two.bmp");
  EXPECT_EQ(scene.textures[0].width, 2);
  EXPECT_THAT(scene.textures[0].rgba, ElementsAre(255, 0, 0, 255, 0, 255, 0, 255));
  EXPECT_EQ(scene.materials[0].diffuse_map.image, 0);
  EXPECT_EQ(scene.materials[1].diffuse_map.image, 0);
  EXPECT_THAT(scene.report.warnings, IsEmpty());
}

TEST(JsonScene, ARectLightWithATextureIsAWindow) {
  write_file(scratch().file("two.bmp"), bmp_file());
  Scene scene = read_text(R"({"objects": [], "lights": [
      {"type": "point", "position": [0, 9, 0], "intensity": [1, 1, 1]},
      {"type": "rect", "name": "glass", "corner": [0, 1, 0], "edge_u": [2, 0, 0],
       "edge_v": [0, 3, 0], "radiance": [5, 5, 5], "texture": "two.bmp"}]})");
  ASSERT_EQ(scene.lights.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.objects.at(0).name, "glass");
  EXPECT_EQ(scene.meshes.at(0).positions[0], Vec3(0, 1, 0));
  EXPECT_EQ(scene.meshes.at(0).positions[2], Vec3(2, 4, 0));
  const Material& m = scene.materials.at(scene.instances[0].material);
  EXPECT_FALSE(m.double_sided);
  finish_scene(scene, "a.json");
  // Red and green.
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[1].emission, Vec3(5, 0, 0));
  EXPECT_EQ(scene.lights[2].emission, Vec3(0, 5, 0));
}

TEST(JsonScene, AMaterialsEmissionTextureLights) {
  write_file(scratch().file("two.bmp"), bmp_file());
  const Scene scene =
      read_text(with_material(R"({"emission": [7, 7, 7], "emission_texture": "two.bmp"})"));
  EXPECT_EQ(scene.materials.at(0).emission_map.image, 0);
  EXPECT_TRUE(scene.materials.at(0).emission_map_lights);
  EXPECT_FALSE(scene.materials.at(0).diffuse_map.used());
}

TEST(JsonScene, UndecodableTextureIsWhiteWithAWarning) {
  write_file(scratch().file("bad.png"), "no picture");
  const Scene scene = read_text(R"({"objects": [], "materials": {
      "a": {"texture": "bad.png"}, "b": {"texture": "bad.png"}}})");
  EXPECT_TRUE(scene.textures.empty());
  EXPECT_FALSE(scene.materials[0].diffuse_map.used());
  ASSERT_EQ(scene.report.warnings.size(), 1u);
  EXPECT_EQ(scratch().strip(scene.report.warnings[0]),
            "bad.png: the image cannot be decoded; it counts as white");
}

TEST(JsonScene, Quad) {
  const Scene scene = read_text(with_object(
      R"({"type": "quad", "name": "wall", "corner": [1, 2, 3], "edge_u": [2, 0, 0],
          "edge_v": [0, 4, 0], "material": "metal"})"));
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.objects[0].name, "wall");
  EXPECT_EQ(scene.materials[scene.instances[0].material].name, "metal");
  const Mesh& mesh = scene.meshes[0];
  EXPECT_THAT(mesh.positions,
              ElementsAre(Vec3(1, 2, 3), Vec3(3, 2, 3), Vec3(3, 6, 3), Vec3(1, 6, 3)));
  EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2, 0, 2, 3));
  // The picture stands upright: its lower left corner is the quad's, v counts from above.
  EXPECT_EQ(mesh.uv[0][0].x, 0);
  EXPECT_EQ(mesh.uv[0][0].y, 1);
  EXPECT_EQ(mesh.uv[0][2].x, 1);
  EXPECT_EQ(mesh.uv[0][2].y, 0);
}

TEST(JsonScene, Sphere) {
  const Scene scene = read_text(with_object(
      R"({"type": "sphere", "center": [1, 2, 3], "radius": 0.5, "material": "metal"})"));
  ASSERT_EQ(scene.spheres.size(), 1u);
  expect_near(scene.spheres[0].center, Vec3(1, 2, 3));
  EXPECT_FLOAT_EQ(scene.spheres[0].radius, 0.5f);
  EXPECT_EQ(scene.spheres[0].object, 0u);
  EXPECT_EQ(scene.objects[0].name, "sphere 0");
}

TEST(JsonScene, TextureIsLeftOutOnSpheres) {
  write_file(scratch().file("two.bmp"), bmp_file());
  const Scene scene =
      read_text(R"({"materials": {"a": {"diffuse": [0, 0, 1], "texture": "two.bmp"}},
      "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "a"},
                  {"type": "sphere", "center": [3, 0, 0], "radius": 1, "material": "a"},
                  {"type": "box", "min": [5, 0, 0], "max": [6, 1, 1], "material": "a"}]})");
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.spheres[0].material, 1u);
  EXPECT_EQ(scene.spheres[1].material, 1u);
  EXPECT_EQ(scene.instances[0].material, 0u);
  EXPECT_FALSE(scene.materials[1].diffuse_map.used());
  expect_near(scene.materials[1].diffuse, Vec3(0, 0, 1));
  EXPECT_THAT(scene.report.warnings,
              ElementsAre("sphere objects have no texture coordinates: the texture of material "
                          "\"a\" is left out there"));
}

TEST(JsonScene, EmissiveSphereBecomesALightAfterTheOthers) {
  const Scene scene = read_text(R"({"materials": {"glow": {"emission": [3, 2, 1]}},
      "objects": [{"type": "sphere", "name": "bulb", "center": [1, 2, 3], "radius": 0.5,
                   "material": "glow"}],
      "lights": [{"type": "point", "position": [0, 9, 0], "intensity": [1, 1, 1]}]})");
  EXPECT_TRUE(scene.spheres.empty());
  ASSERT_EQ(scene.lights.size(), 2u);
  const Light& light = scene.lights[1];
  EXPECT_EQ(light.type, LightType::sphere);
  EXPECT_EQ(light.name, "bulb");
  expect_near(light.position, Vec3(1, 2, 3));
  expect_near(light.emission, Vec3(3, 2, 1));
  EXPECT_FLOAT_EQ(light.radius, 0.5f);
  EXPECT_THAT(scene.report.conversions,
              ElementsAre("the emissive sphere object \"bulb\" became sphere light 1, which is "
                          "not itself seen and blocks no light"));
}

TEST(JsonScene, BoxFacesOutward) {
  const Scene scene = read_text(
      with_object(R"({"type": "box", "min": [1, 2, 3], "max": [2, 4, 6], "material": "floor"})"));
  const Mesh& mesh = scene.meshes.at(0);
  EXPECT_EQ(mesh.triangle_count(), 12u);
  EXPECT_NEAR(area(mesh), 2 * (1 * 2 + 2 * 3 + 3 * 1), 1e-5);
  EXPECT_NEAR(volume(mesh), 6, 1e-5);
  const Vec3 centre(1.5f, 3, 4.5f);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3 a = mesh.positions[mesh.indices[i]];
    const Vec3 n =
        cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
    EXPECT_GT(dot(n, a - centre), 0) << "triangle " << i / 3;
  }
}

TEST(JsonScene, PolygonKeepsItsVerticesAndIsMappedInMetres) {
  const Scene scene = read_text(with_object(
      R"({"type": "polygon", "material": "floor",
          "vertices": [[0, 1, 0], [0, 1, 3], [2, 1, 3], [2, 1, 0]]})"));
  const Mesh& mesh = scene.meshes.at(0);
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_NEAR(area(mesh), 6, 1e-6);
  EXPECT_FLOAT_EQ(mesh.uv[0][1].x, 3);
  EXPECT_FLOAT_EQ(mesh.uv[0][1].y, 1);
  EXPECT_FLOAT_EQ(mesh.uv[0][3].x, 0);
  EXPECT_FLOAT_EQ(mesh.uv[0][3].y, -1);
}

TEST(JsonScene, SphereLight) {
  const Scene scene = read_text(with_light(
      R"({"type": "sphere", "name": "key", "position": [1, 2, 3], "radius": 0.5, "radiance": [4, 5, 6]})"));
  const Light& light = scene.lights.at(0);
  EXPECT_EQ(light.type, LightType::sphere);
  EXPECT_EQ(light.name, "key");
  expect_near(light.position, Vec3(1, 2, 3));
  EXPECT_FLOAT_EQ(light.radius, 0.5f);
  expect_near(light.emission, Vec3(4, 5, 6));
}

TEST(JsonScene, DiskLight) {
  const Scene scene = read_text(with_light(
      R"({"type": "disk", "position": [1, 2, 3], "normal": [0, -2, 0], "radius": 0.5, "radiance": [4, 5, 6]})"));
  const Light& light = scene.lights.at(0);
  EXPECT_EQ(light.type, LightType::disk);
  expect_near(light.normal, Vec3(0, -1, 0));
  EXPECT_FLOAT_EQ(light.radius, 0.5f);
}

TEST(JsonScene, RectLightEmitsAlongUCrossV) {
  const Scene scene = read_text(with_light(
      R"({"type": "rect", "corner": [1, 2, 3], "edge_u": [2, 0, 0], "edge_v": [0, 0, 4], "radiance": [4, 5, 6]})"));
  const Light& light = scene.lights.at(0);
  EXPECT_EQ(light.type, LightType::rect);
  expect_near(light.position, Vec3(2, 2, 5));
  expect_near(light.normal, Vec3(0, -1, 0));
  expect_near(light.edge_u, Vec3(2, 0, 0));
  expect_near(light.edge_v, Vec3(0, 0, 4));
}

TEST(JsonScene, SegmentLight) {
  const Scene scene = read_text(with_light(
      R"({"type": "segment", "from": [1, 2, 3], "to": [1, 2, 7], "radius": 0.01, "radiance": [4, 5, 6]})"));
  const Light& light = scene.lights.at(0);
  EXPECT_EQ(light.type, LightType::segment);
  expect_near(light.position, Vec3(1, 2, 5));
  expect_near(light.edge_u, Vec3(0, 0, 4));
  EXPECT_FLOAT_EQ(light.radius, 0.01f);
}

TEST(JsonScene, PointLight) {
  const Scene scene =
      read_text(with_light(R"({"type": "point", "position": [1, 2, 3], "intensity": [4, 5, 6]})"));
  const Light& light = scene.lights.at(0);
  EXPECT_EQ(light.type, LightType::point);
  expect_near(light.position, Vec3(1, 2, 3));
  expect_near(light.emission, Vec3(4, 5, 6));
  EXPECT_EQ(light.spot_cos_outer, -1);
}

TEST(JsonScene, SunLight) {
  const Scene scene = read_text(with_light(
      R"({"type": "sun", "direction": [0, -3, 4], "angular_diameter_deg": 2, "irradiance": [4, 5, 6]},
         {"type": "sun", "direction": [0, -1, 0], "irradiance": [1, 1, 1]})"));
  const Light& light = scene.lights.at(0);
  EXPECT_EQ(light.type, LightType::sun);
  expect_near(light.direction, Vec3(0, -0.6f, 0.8f));
  EXPECT_NEAR(light.angular_diameter, 2 * degree, 1e-7f);
  expect_near(light.emission, Vec3(4, 5, 6));
  EXPECT_NEAR(scene.lights.at(1).angular_diameter, 0.53f * degree, 1e-7f);
}

TEST(JsonScene, CommentsStandAnywhere) {
  const Scene scene = read_text(
      "// one\n{/* two */ \"objects\" /* : */ : // [\n [ /**/ ] /* \" */, \"ambient\": [1, /* 9, "
      "*/ 2, "
      "3]} // end");
  expect_near(scene.ambient, Vec3(1, 2, 3));
  EXPECT_EQ(read_text(with_light("{\"type\": \"point\", \"name\": \"a // b /* c\", \"position\": "
                                 "[0, 0, 0], \"intensity\": [1, 1, 1]}"))
                .lights[0]
                .name,
            "a // b /* c");
}

TEST(JsonScene, StarterSceneIsWhole) {
  const Scene scene = read_text(std::string(starter_scene()));
  EXPECT_EQ(scene.objects.size(), 5u);
  EXPECT_EQ(scene.spheres.size(), 3u);
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.cameras.size(), 1u);
  EXPECT_THAT(scene.report.warnings, IsEmpty());
}

TEST(JsonScene, SharedScenesAreRead) {
  for (const char* name :
       {"bridge", "knife-edge", "slats", "sphere-field", "table", "thin-wall", "three-spheres"}) {
    const std::string path =
        std::string(PENUMBRA_SHARED_DIR).append("/oracle/").append(name).append(".json");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    EXPECT_GE(read_json_scene(path).lights.size(), 4u) << name;
  }
}

}  // namespace
}  // namespace penumbra::test
