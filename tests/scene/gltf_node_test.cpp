// glTF: the node hierarchy.
#include <gmock/gmock.h>

#include "scene/gltf_file.h"

namespace penumbra {
namespace {

using test::error_of;
using test::GltfFile;
using test::read;

std::string nodes(const std::string& list, const std::string& scenes = "") {
  GltfFile file;
  file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  return file.text(R"("meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0}}]}],)"
                   R"("nodes":[)" +
                   list + "]" + (scenes.empty() ? "" : "," + scenes));
}

void expect_near(const Vec3d& a, const Vec3d& b) {
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
  EXPECT_NEAR(a.z, b.z, 1e-12);
}

TEST(GltfNode, ReadsMatricesByColumns) {
  const Scene scene = read(nodes(R"({"mesh":0,"matrix":[0,1,0,0, -2,0,0,0, 0,0,3,0, 4,5,6,1]})"));
  const Affine& m = scene.instances.at(0).world_from_mesh;
  expect_near(m.x, {0, 1, 0});
  expect_near(m.y, {-2, 0, 0});
  expect_near(m.z, {0, 0, 3});
  expect_near(m.t, {4, 5, 6});
}

TEST(GltfNode, ScalesThenRotatesThenMoves) {
  // A quarter turn about z, by a quaternion that is not of unit length.
  const Scene scene =
      read(nodes(R"({"mesh":0,"translation":[4,5,6],"rotation":[0,0,2,2],"scale":[2,3,-1]})"));
  const Affine& m = scene.instances.at(0).world_from_mesh;
  expect_near(m.x, {0, 2, 0});
  expect_near(m.y, {-3, 0, 0});
  expect_near(m.z, {0, 0, -1});
  expect_near(m.t, {4, 5, 6});
}

TEST(GltfNode, MultipliesDownTheHierarchyWhateverTheOrder) {
  const Scene scene = read(nodes(R"({"mesh":0,"translation":[1,0,0]},)"
                                 R"({"children":[0],"scale":[2,2,2]},)"
                                 R"({"children":[1],"translation":[0,7,0]})",
                                 R"("scenes":[{"nodes":[2]}])"));
  expect_near(scene.instances.at(0).world_from_mesh.t, {2, 7, 0});
}

TEST(GltfNode, KeepsInstancesAsInstances) {
  const Scene scene = read(nodes(R"({"mesh":0,"name":"a"},{"mesh":0,"scale":[-1,1,1]})"));
  EXPECT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[1].mesh, 0u);
  EXPECT_LT(scene.instances[1].world_from_mesh.determinant(), 0);
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[0].name, "a");
  EXPECT_EQ(scene.objects[1].name, "m");
  EXPECT_EQ(scene.instances[1].object, 1u);
}

TEST(GltfNode, ShowsTheDefaultSceneElseTheFirstElseAllRoots) {
  const std::string two = R"({"mesh":0,"name":"a"},{"mesh":0,"name":"b"})";
  const std::string scenes = R"("scenes":[{"nodes":[0]},{"nodes":[1]}])";
  EXPECT_EQ(read(nodes(two, R"("scene":1,)" + scenes)).objects.at(0).name, "b");
  EXPECT_EQ(read(nodes(two, scenes)).objects.at(0).name, "a");
  EXPECT_EQ(read(nodes(two)).objects.size(), 2u);
  EXPECT_EQ(read(nodes(two, R"("scenes":[{}])")).objects.size(), 0u);
}

TEST(GltfNode, GoesDownTwentyThousandLevels) {
  std::string list;
  const int depth = 20000;
  for (int i = 0; i < depth; ++i)
    list += fmt::format(R"({{"translation":[0,0,1],"children":[{}]}},)", i + 1);
  list += R"({"mesh":0})";
  const Scene scene = read(nodes(list, R"("scenes":[{"nodes":[0]}])"));
  expect_near(scene.instances.at(0).world_from_mesh.t, {0, 0, depth});
}

TEST(GltfNode, RefusesCycles) {
  EXPECT_EQ(error_of(test::bare(R"("nodes":[{"children":[1]},{"children":[0]}])")),
            "a.gltf:1:37: nodes[0]: it is its own ancestor; correct the hierarchy or export the "
            "file again");
  EXPECT_EQ(error_of(test::bare(R"("nodes":[{},{"children":[2]},{"children":[2]}])")),
            "a.gltf:1:70: nodes[2].children[0]: nodes[2] has two parents; correct the hierarchy or "
            "export the file again");
  EXPECT_EQ(error_of(test::bare(R"("nodes":[{"children":[1]},{"children":[2]},{"children":[1]}])")),
            "a.gltf:1:84: nodes[2].children[0]: nodes[1] has two parents; correct the hierarchy or "
            "export the file again");
  EXPECT_EQ(error_of(test::bare(R"("nodes":[{"children":[0]}])")),
            "a.gltf:1:37: nodes[0]: it is its own ancestor; correct the hierarchy or export the "
            "file again");
}

TEST(GltfNode, RefusesTwoParents) {
  EXPECT_EQ(error_of(test::bare(R"("nodes":[{"children":[2]},{"children":[2]},{}])")),
            "a.gltf:1:67: nodes[1].children[0]: nodes[2] has two parents; correct the hierarchy or "
            "export the file again");
}

TEST(GltfNode, RefusesASceneRootThatHasAParent) {
  EXPECT_EQ(error_of(test::bare(R"("nodes":[{"children":[1]},{}],"scenes":[{"nodes":[1]}])")),
            "a.gltf:1:78: scenes[0].nodes[0]: nodes[1] is no root: it is a child of nodes[0]; "
            "correct the hierarchy or export the file again");
}

}  // namespace
}  // namespace penumbra
