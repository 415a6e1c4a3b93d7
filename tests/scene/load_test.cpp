#include "scene/load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "json_support.h"
#include "scene/starter.h"

namespace penumbra::test {
namespace {

std::string load_error(const std::string& name) {
  try {
    load_scene(scratch().file(name));
  } catch (const InputError& e) {
    return scratch().strip(e.what());
  }
  return "(no error)";
}

Scene load_text(const std::string& name, const std::string& text) {
  write_file(scratch().file(name), text);
  return load_scene(scratch().file(name));
}

constexpr const char* triangle_obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
constexpr const char* triangle_stl =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
    "endloop\nendfacet\nendsolid a\n";

TEST(Load, MissingFile) {
  EXPECT_EQ(load_error("gone.json"), "gone.json: there is no such file; check the name");
  EXPECT_EQ(load_error("gone.glb"), "gone.glb: there is no such file; check the name");
}

TEST(Load, UnknownExtension) {
  EXPECT_EQ(load_error("a.fbx"),
            "a.fbx: unknown file format \".fbx\"; known are .json, .gltf, .glb, .obj, .ply, "
            ".ply.gz, .stl, .glsl");
  EXPECT_EQ(load_error("a.obj.gz"),
            "a.obj.gz: unknown file format \".gz\"; known are .json, .gltf, .glb, .obj, .ply, "
            ".ply.gz, .stl, .glsl");
  EXPECT_EQ(load_error("scene"),
            "scene: the file name has no extension; known are .json, .gltf, .glb, .obj, .ply, "
            ".ply.gz, .stl, .glsl");
}

TEST(Load, AShaderAlone) {
  const Scene scene = load_text("a.GLSL", "float map(vec3 p) { return length(p) - 1.0; }");
  ASSERT_TRUE(scene.glsl);
  EXPECT_EQ(scene.glsl->text, "float map(vec3 p) { return length(p) - 1.0; }");
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].position, Vec3(3.2f, 2.6f, 4.4f));
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_NEAR(scene.lights[0].angular_diameter, 0.1047198f, 1e-6f);
  EXPECT_NEAR(length(scene.lights[0].direction), 1, 1e-6);
}

TEST(Load, AShaderWithoutMap) {
  write_file(scratch().file("b.glsl"),
             "// map(p)\nfloat bitmap(vec3 p) { return /* map(p) */ 1.0; }");
  EXPECT_EQ(load_error("b.glsl"),
            "b.glsl: the shader has no map and no mainImage; give it a float map(vec3 p), the "
            "distance from p");
  EXPECT_TRUE(load_text("c.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }").glsl);
}

TEST(Load, Folder) {
  std::filesystem::create_directories(scratch().file("folder.json"));
  EXPECT_EQ(load_error("folder.json"), "folder.json: this is a folder; name a file");
}

TEST(Load, EveryExtensionInAnyCase) {
  EXPECT_EQ(load_text("a.OBJ", triangle_obj).instances.size(), 1u);
  EXPECT_EQ(load_text("a.Stl", triangle_stl).instances.size(), 1u);
  EXPECT_EQ(load_text("a.JSON", std::string(starter_scene())).spheres.size(), 3u);
}

TEST(Load, AddsCameraAndLightUnlessToldNotTo) {
  const Scene scene = load_text("b.obj", triangle_obj);
  EXPECT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.lights.size(), 1u);
  LoadOptions bare;
  bare.add_missing_camera_and_light = false;
  const Scene unlit = load_scene(scratch().file("b.obj"), bare);
  EXPECT_TRUE(unlit.cameras.empty() && unlit.lights.empty());
}

TEST(Load, StarterSceneKeepsItsOwn) {
  const Scene scene = load_text("starter.json", std::string(starter_scene()));
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].name, "key");
  EXPECT_EQ(scene.cameras.size(), 1u);
}

TEST(Load, SceneWithoutGeometryIsRefused) {
  write_file(scratch().file("none.json"), R"({"objects": []})");
  EXPECT_EQ(load_error("none.json").substr(0, 10), "none.json:");
}

TEST(Load, EmissiveBoxIsAMeshLight) {
  const Scene scene = load_text("glow.json", R"({"materials": {"glow": {"emission": [2, 2, 2]}},
      "objects": [{"type": "box", "min": [0, 0, 0], "max": [1, 1, 1], "material": "glow"}]})");
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].type, LightType::mesh);
}

TEST(Load, ModelsTakeNoScenes) { EXPECT_THROW(read_model(scratch().file("a.json")), InputError); }

}  // namespace
}  // namespace penumbra::test
