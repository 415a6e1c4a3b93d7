// Mesh objects: other files placed in a JSON scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "json_support.h"

namespace penumbra::test {
namespace {

using testing::ElementsAre;

constexpr const char* triangle_obj = "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n";

Scene read_meshes(const std::string& objects) {
  write_file(scratch().file("tri.obj"), triangle_obj);
  return read_text(with_object(objects));
}

// Where the vertices of instance 0 stand: a, b, c are the images of the axes.
void expect_axes(const Scene& scene, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Instance& instance = scene.instances.at(0);
  const Mesh& mesh = scene.meshes.at(instance.mesh);
  const Vec3 expected[] = {a, b, c};
  for (int i = 0; i < 3; ++i) {
    const Vec3 p =
        instance.world_from_mesh.point(mesh.positions.at(mesh.indices.at(std::size_t(i))));
    EXPECT_NEAR(length(p - expected[i]), 0, 1e-6f) << i << ": " << p.x << " " << p.y << " " << p.z;
  }
}

TEST(JsonMesh, TransformIsOptional) {
  const Scene scene = read_meshes(R"({"type": "mesh", "file": "tri.obj"})");
  expect_axes(scene, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
}

TEST(JsonMesh, ScaleThenTranslate) {
  expect_axes(read_meshes(R"({"type": "mesh", "file": "tri.obj",
                              "transform": {"translate": [10, 20, 30], "scale": 2}})"),
              {12, 20, 30}, {10, 22, 30}, {10, 20, 32});
  expect_axes(
      read_meshes(R"({"type": "mesh", "file": "tri.obj", "transform": {"scale": [2, 3, -4]}})"),
      {2, 0, 0}, {0, 3, 0}, {0, 0, -4});
}

TEST(JsonMesh, RotationsAreCounterClockwise) {
  expect_axes(
      read_meshes(
          R"({"type": "mesh", "file": "tri.obj", "transform": {"rotate_deg": [90, 0, 0]}})"),
      {1, 0, 0}, {0, 0, 1}, {0, -1, 0});
  expect_axes(
      read_meshes(
          R"({"type": "mesh", "file": "tri.obj", "transform": {"rotate_deg": [0, 90, 0]}})"),
      {0, 0, -1}, {0, 1, 0}, {1, 0, 0});
  expect_axes(
      read_meshes(
          R"({"type": "mesh", "file": "tri.obj", "transform": {"rotate_deg": [0, 0, 90]}})"),
      {0, 1, 0}, {-1, 0, 0}, {0, 0, 1});
}

TEST(JsonMesh, TurnsAboutXFirstThenYThenZ) {
  // x: (0,1,0) -> (0,0,1); then y: (0,0,1) -> (1,0,0); then z: (1,0,0) -> (0,1,0).
  expect_axes(
      read_meshes(
          R"({"type": "mesh", "file": "tri.obj", "transform": {"rotate_deg": [90, 90, 90]}})"),
      {0, 0, -1}, {0, 1, 0}, {1, 0, 0});
}

TEST(JsonMesh, FileOfSeveralObjectsIsLoadedOnce) {
  const Scene scene = read_meshes(R"(
      {"type": "mesh", "file": "tri.obj"},
      {"type": "box", "min": [0, 0, 0], "max": [1, 1, 1], "material": "floor"},
      {"type": "mesh", "file": "tri.obj", "material": "metal", "transform": {"translate": [5, 0, 0]}})");
  EXPECT_EQ(scene.meshes.size(), 2u);
  ASSERT_EQ(scene.instances.size(), 3u);
  EXPECT_EQ(scene.instances[0].mesh, scene.instances[2].mesh);
  EXPECT_NE(scene.instances[0].material, scene.instances[2].material);
  EXPECT_EQ(scene.materials[scene.instances[2].material].name, "metal");
  EXPECT_EQ(scene.instances[0].object, 0u);
  EXPECT_EQ(scene.instances[2].object, 2u);
  EXPECT_EQ(scene.instances[2].world_from_mesh.t, Vec3d(5, 0, 0));
  EXPECT_GE(scene.instances[0].material, 2u) << "the file's own material";
}

TEST(JsonMesh, FileWithoutTriangleIsRefused) {
  write_file(scratch().file("empty.obj"), "v 0 0 0\nv 1 0 0\n");
  EXPECT_THROW(read_text(with_object(R"({"type": "mesh", "file": "empty.obj"})")), InputError);
}

TEST(JsonMesh, SceneFileIsNoModel) {
  write_file(scratch().file("s.json"), "{}");
  EXPECT_EQ(
      error_of(with_object(R"({"type": "mesh", "file": "s.json"})")),
      "s.json: unknown file format \".json\"; known are .gltf, .glb, .obj, .ply, .ply.gz, .stl");
}

}  // namespace
}  // namespace penumbra::test
