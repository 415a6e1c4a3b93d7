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
            ".ply.gz, .stl");
  EXPECT_EQ(load_error("a.obj.gz"),
            "a.obj.gz: unknown file format \".gz\"; known are .json, .gltf, .glb, .obj, .ply, "
            ".ply.gz, .stl");
  EXPECT_EQ(load_error("scene"),
            "scene: the file name has no extension; known are .json, .gltf, .glb, .obj, .ply, "
            ".ply.gz, .stl");
}

TEST(Load, DistanceFieldsAreRefusedByName) {
  EXPECT_EQ(load_error("a.GLSL"),
            "a.GLSL: distance-field shaders (.glsl) are not supported by this version; use a scene "
            "of triangles and spheres");
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
