// glTF: triangles out of every kind of primitive and accessor.
#include <gmock/gmock.h>

#include "scene/gltf_file.h"

namespace penumbra {
namespace {

using test::GltfFile;
using test::one_node;
using test::read;
using testing::ElementsAre;
using testing::HasSubstr;

/// Matches a vector to 1e-6.
auto IsVec(float x, float y, float z) {
  return testing::AllOf(testing::Field(&Vec3::x, testing::FloatNear(x, 1e-6f)),
                        testing::Field(&Vec3::y, testing::FloatNear(y, 1e-6f)),
                        testing::Field(&Vec3::z, testing::FloatNear(z, 1e-6f)));
}

const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

Mesh square(const std::string& members, const std::vector<std::uint16_t>& indices) {
  GltfFile file;
  file.positions(kSquare);
  file.indices(indices);
  return read(file.text(one_node(R"({"attributes":{"POSITION":0},"indices":1)" + members + "}")))
      .meshes.at(0);
}

TEST(GltfMesh, ReadsIndexedTriangles) {
  const Mesh mesh = square("", {0, 1, 2, 0, 2, 3});
  EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2, 0, 2, 3));
  ASSERT_EQ(mesh.positions.size(), 4u);
  EXPECT_THAT(mesh.positions[2], IsVec(1, 1, 0));
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.uv[0].empty());
  EXPECT_EQ(mesh.name, "m");
}

TEST(GltfMesh, ReadsTrianglesWithoutIndices) {
  GltfFile file;
  file.positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1});
  const Scene scene = read(file.text(one_node(R"({"attributes":{"POSITION":0}})")));
  EXPECT_THAT(scene.meshes.at(0).indices, ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(GltfMesh, StripsKeepTheirWinding) {
  EXPECT_THAT(square(R"(,"mode":5)", {0, 1, 3, 2}).indices, ElementsAre(0, 1, 3, 1, 2, 3));
}

TEST(GltfMesh, FansTurnAroundTheirFirstVertex) {
  EXPECT_THAT(square(R"(,"mode":6)", {0, 1, 2, 3}).indices, ElementsAre(1, 2, 0, 2, 3, 0));
}

TEST(GltfMesh, DropsWhatIsLeftOverBeyondTheLastTriangle) {
  EXPECT_THAT(square("", {0, 1, 2, 3, 0}).indices, ElementsAre(0, 1, 2));
  EXPECT_TRUE(square(R"(,"mode":5)", {0, 1}).indices.empty());
}

TEST(GltfMesh, KeepsOnlyTheVerticesInUse) {
  const Mesh mesh = square("", {3, 1, 2});
  ASSERT_EQ(mesh.positions.size(), 3u);
  EXPECT_THAT(mesh.indices, ElementsAre(2, 0, 1));
  EXPECT_THAT(mesh.positions[0], IsVec(1, 0, 0));
  EXPECT_THAT(mesh.positions[2], IsVec(0, 1, 0));
}

TEST(GltfMesh, KeepsOnlyTheVerticesInUseFarApart) {
  GltfFile file;
  std::vector<float> numbers(3 * 1000, 0);
  numbers[3 * 999] = 9;
  numbers[3 * 500] = 5;
  file.positions(numbers);
  file.indices({999, 0, 500});
  const Scene scene = read(file.text(one_node(R"({"attributes":{"POSITION":0},"indices":1})")));
  const Mesh& mesh = scene.meshes.at(0);
  ASSERT_EQ(mesh.positions.size(), 3u);
  EXPECT_THAT(mesh.indices, ElementsAre(2, 0, 1));
  EXPECT_EQ(mesh.positions[1].x, 5);
  EXPECT_EQ(mesh.positions[2].x, 9);
}

TEST(GltfMesh, ReadsEveryIndexWidth) {
  for (const int type : {5121, 5123, 5125}) {
    GltfFile file;
    file.positions(kSquare);
    const int view = type == 5121   ? file.view(std::vector<std::uint8_t>{2, 3, 0})
                     : type == 5123 ? file.view(std::vector<std::uint16_t>{2, 3, 0})
                                    : file.view(std::vector<std::uint32_t>{2, 3, 0});
    file.accessor(view, type, "SCALAR", 3);
    const Scene scene = read(file.text(one_node(R"({"attributes":{"POSITION":0},"indices":1})")));
    EXPECT_THAT(scene.meshes.at(0).indices, ElementsAre(1, 2, 0)) << type;
  }
}

TEST(GltfMesh, ReadsStridedAccessors) {
  GltfFile file;
  const int view =
      file.view(std::vector<float>{9, 0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0}, R"(,"byteStride":16)");
  file.accessor(view, 5126, "VEC3", 3, R"(,"byteOffset":4)");
  const Scene scene = read(file.text(one_node(R"({"attributes":{"POSITION":0}})")));
  EXPECT_THAT(scene.meshes.at(0).positions,
              ElementsAre(IsVec(0, 0, 0), IsVec(1, 0, 0), IsVec(0, 1, 0)));
}

std::string sparse(int indices, int values) {
  return fmt::format(R"(,"sparse":{{"count":2,"indices":{{"bufferView":{},"componentType":5121}},)"
                     R"("values":{{"bufferView":{}}}}})",
                     indices, values);
}

TEST(GltfMesh, ReadsSparseAccessors) {
  GltfFile file;
  const int base = file.view(kSquare);
  const int at = file.view(std::vector<std::uint8_t>{1, 2});
  const int values = file.view(std::vector<float>{7, 7, 7, 8, 8, 8});
  file.accessor(base, 5126, "VEC3", 3, sparse(at, values));
  const Scene scene = read(file.text(one_node(R"({"attributes":{"POSITION":0}})")));
  EXPECT_THAT(scene.meshes.at(0).positions,
              ElementsAre(IsVec(0, 0, 0), IsVec(7, 7, 7), IsVec(8, 8, 8)));
}

TEST(GltfMesh, ReadsSparseAccessorsWithoutABase) {
  GltfFile file;
  const int at = file.view(std::vector<std::uint8_t>{1, 2});
  const int values = file.view(std::vector<float>{1, 0, 0, 0, 1, 0});
  const int order = file.view(std::vector<std::uint8_t>{2, 1});
  file.accessor(-1, 5126, "VEC3", 3, sparse(at, values));
  file.accessor(-1, 5121, "SCALAR", 3, sparse(at, order));
  const Scene scene = read(file.text(one_node(R"({"attributes":{"POSITION":0},"indices":1})")));
  EXPECT_THAT(scene.meshes.at(0).positions,
              ElementsAre(IsVec(0, 0, 0), IsVec(1, 0, 0), IsVec(0, 1, 0)));
  EXPECT_THAT(scene.meshes.at(0).indices, ElementsAre(0, 2, 1));
}

TEST(GltfMesh, ReadsQuantisedPositionsAndNormals) {
  GltfFile file;
  const int bytes = file.view(std::vector<std::int8_t>{0, 0, 0, 0, 100, 0, 0, 0, 0, -100, 0, 0},
                              R"(,"byteStride":4)");
  file.accessor(bytes, 5120, "VEC3", 3);
  const int normals = file.view(std::vector<std::int16_t>{0, 0, 32767, 0, 0, 0, -32768, 0,  //
                                                          0, -32767, 0, 0},
                                R"(,"byteStride":8)");
  file.accessor(normals, 5122, "VEC3", 3, R"(,"normalized":true)");
  const Scene scene = read(file.text(R"("extensionsRequired":["KHR_mesh_quantization"],)" +
                                     one_node(R"({"attributes":{"POSITION":0,"NORMAL":1}})")));
  const Mesh& mesh = scene.meshes.at(0);
  EXPECT_THAT(mesh.positions, ElementsAre(IsVec(0, 0, 0), IsVec(100, 0, 0), IsVec(0, -100, 0)));
  EXPECT_THAT(mesh.normals, ElementsAre(IsVec(0, 0, 1), IsVec(0, 0, -1), IsVec(0, -1, 0)));
}

TEST(GltfMesh, ReadsBothSetsOfTextureCoordinates) {
  GltfFile file;
  file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int bytes = file.view(std::vector<std::uint8_t>{0, 255, 0, 0, 51, 0, 0, 0, 0, 0, 0, 0},
                              R"(,"byteStride":4)");
  file.accessor(bytes, 5121, "VEC2", 3, R"(,"normalized":true)");
  const int shorts = file.view(std::vector<std::uint16_t>{0, 0, 65535, 0, 0, 13107});
  file.accessor(shorts, 5123, "VEC2", 3, R"(,"normalized":true)");
  const Scene scene =
      read(file.text(one_node(R"({"attributes":{"POSITION":0,"TEXCOORD_0":1,"TEXCOORD_1":2}})")));
  const Mesh& mesh = scene.meshes.at(0);
  ASSERT_EQ(mesh.uv[0].size(), 3u);
  ASSERT_EQ(mesh.uv[1].size(), 3u);
  EXPECT_FLOAT_EQ(mesh.uv[0][0].y, 1);
  EXPECT_FLOAT_EQ(mesh.uv[0][1].x, 0.2f);
  EXPECT_FLOAT_EQ(mesh.uv[1][1].x, 1);
  EXPECT_FLOAT_EQ(mesh.uv[1][2].y, 0.2f);
}

TEST(GltfMesh, OneMeshForEachPrimitive) {
  GltfFile file;
  file.positions(kSquare);
  file.indices({0, 1, 2});
  file.indices({0, 2, 3});
  const Scene scene = read(file.text(one_node(R"({"attributes":{"POSITION":0},"indices":1},)"
                                              R"({"attributes":{"POSITION":0},"indices":2})")));
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.objects.size(), 1u);
  EXPECT_THAT(scene.meshes[1].positions[2], IsVec(0, 1, 0));
}

TEST(GltfMesh, LeavesOutPointsAndLinesWithAWarning) {
  const Scene scene =
      read(test::triangle_with("", R"(,"mode":1},{"attributes":{"POSITION":0},"mode":0)"));
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_THAT(scene.report.warnings, ElementsAre("points and lines are left out (2 times, first in "
                                                 "meshes[0].primitives[0])"));
}

TEST(GltfMesh, LeavesOutPrimitivesWithoutPositions) {
  const Scene scene = read(test::bare(one_node(R"({"attributes":{}})")));
  EXPECT_TRUE(scene.meshes.empty());
  EXPECT_THAT(scene.report.warnings, ElementsAre(HasSubstr("without positions")));
}

TEST(GltfMesh, ShowsMorphedAndSkinnedMeshesUndeformed) {
  GltfFile file;
  file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const Scene scene =
      read(file.text(R"("meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0},)"
                     R"("targets":[{"POSITION":0}]}]}],"skins":[{"joints":[0]}],)"
                     R"("nodes":[{"name":"n","mesh":0,"skin":0}],"scenes":[{"nodes":[0]}])"));
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_THAT(scene.report.warnings,
              ElementsAre("skins are left out: the mesh is shown as modelled (n)",
                          "morph targets are left out: the mesh is shown undeformed (m)"));
}

TEST(GltfMesh, ReadsBinaryFiles) {
  GltfFile file;
  file.positions({0, 0, 0, 1, 0, 0, 0, 1, 5});
  const Scene scene = read(file.binary(one_node(R"({"attributes":{"POSITION":0}})")), "a.glb");
  EXPECT_THAT(scene.meshes.at(0).positions[2], IsVec(0, 1, 5));
  EXPECT_EQ(scene.report.format, "glTF 2.0 (binary)");
  EXPECT_EQ(read(test::triangle_with("")).report.format, "glTF 2.0 (text)");
}

}  // namespace
}  // namespace penumbra
