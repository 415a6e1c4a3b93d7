#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/load.h"
#include "scene/mesh_files.h"

namespace penumbra {
namespace {

using test::input_error;
using test::put;
using test::TempFolder;
using testing::ElementsAre;

constexpr const char* kTriangle =
    "ply\nformat ascii 1.0\ncomment a triangle\nelement vertex 3\nproperty float x\n"
    "property float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\n"
    "end_header\n0 0 0\n1.5 0 0\n0 +2 -1e-1\n3 0 1 2\n";

class Ply : public testing::Test {
 protected:
  Mesh read(const std::string& contents) {
    return read_ply(folder.write("a.ply", contents)).meshes.at(0);
  }
  std::string error(const std::string& contents) {
    const std::string path = folder.write("a.ply", contents);
    return input_error(folder, [&] { read_ply(path); });
  }
  std::string error_with(const std::string& from, const std::string& to) {
    std::string contents = kTriangle;
    contents.replace(contents.find(from), from.size(), to);
    return error(contents);
  }
  TempFolder folder;
};

TEST_F(Ply, Ascii) {
  const Scene scene = read_ply(folder.write("tri.ply", kTriangle));
  ASSERT_EQ(scene.meshes.size(), 1u);
  const Mesh& mesh = scene.meshes[0];
  EXPECT_THAT(mesh.positions, ElementsAre(Vec3{0, 0, 0}, Vec3{1.5f, 0, 0}, Vec3{0, 2, -0.1f}));
  EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2));
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_EQ(mesh.name, "tri");
  EXPECT_EQ(scene.objects.at(0).name, "tri");
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.report.format, "Stanford PLY (ascii)");
}

TEST_F(Ply, PropertiesInAnyOrderOthersSkipped) {
  const Mesh mesh = read(
      "ply\r\nformat ascii 1.0\r\nobj_info x\r\nelement camera 1\r\nproperty list int float m\r\n"
      "element vertex 3\r\nproperty double z\r\nproperty list uchar float weights\r\n"
      "property float nx\r\nproperty float ny\r\nproperty float nz\r\nproperty uchar red\r\n"
      "property int y\r\nproperty float x\r\nproperty float t\r\nproperty float s\r\n"
      "element empty 7\r\nelement face 1\r\nproperty uchar flag\r\n"
      "property list uint8 uint32 vertex_index\r\nproperty list uchar float texcoord\r\n"
      "end_header\r\n2 8.5 9\r\n\r\n3 2 7 7 0 0 1 255 2 1 .25 .75\r\n3 0 0 1 0 255 2 4 0 0\r\n"
      "3 0 1 0 0 255 5 4 0 0\r\n9 3 2 1 0 6 .1 .1 .1 .1 .1 .1\r\n");
  EXPECT_THAT(mesh.positions, ElementsAre(Vec3{1, 2, 3}, Vec3{4, 2, 3}, Vec3{4, 5, 3}));
  EXPECT_THAT(mesh.normals, ElementsAre(Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{1, 0, 0}));
  EXPECT_EQ(mesh.uv[0].at(0).x, 0.75f);
  EXPECT_EQ(mesh.uv[0].at(0).y, 1 - 0.25f) << "the first row of a texture is the top";
  EXPECT_THAT(mesh.indices, ElementsAre(2, 1, 0));
}

TEST_F(Ply, FacesBeforeVertices) {
  const Mesh mesh = read(
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
      "element vertex 4\nproperty int x\nproperty int y\nproperty int z\nend_header\n"
      "4 0 1 2 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n");
  EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2, 0, 2, 3));
}

TEST_F(Ply, ConcavePolygon) {
  const Mesh mesh = read(
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n2 0 0\n2 2 0\n1 0.5 0\n0 2 0\n5 0 1 2 3 4\n");
  EXPECT_EQ(mesh.triangle_count(), 3u);
  EXPECT_NEAR(test::area_vector(mesh).z, 2 * 2.5, 1e-6);
}

TEST_F(Ply, SmallFacesAreReported) {
  const Scene scene = read_ply(folder.write(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 3\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n2 0 1\n3 0 1 2\n0\n"));
  EXPECT_EQ(scene.meshes[0].triangle_count(), 1u);
  EXPECT_THAT(scene.report.warnings,
              ElementsAre("2 faces with fewer than three corners were left out"));
}

/// Two triangles with every scalar type, in either byte order; faces first if asked.
std::string binary(bool big, bool faces_first = false) {
  const std::string vertex =
      "element vertex 4\nproperty char a\nproperty double y\nproperty ushort b\nproperty short x\n"
      "property list ushort double c\nproperty float z\n";
  const std::string face =
      "element face 2\nproperty list int ushort vertex_indices\nproperty int d\n";
  std::string vertices, faces;
  for (int i = 0; i < 4; ++i) {
    put<std::int8_t>(vertices, -1);
    put<double>(vertices, 0.5 * i, big);
    put<std::uint16_t>(vertices, 9, big);
    put<std::int16_t>(vertices, static_cast<std::int16_t>(-i), big);
    put<std::uint16_t>(vertices, static_cast<std::uint16_t>(i), big);
    for (int k = 0; k < i; ++k) put<double>(vertices, 7, big);
    put<float>(vertices, static_cast<float>(i * i), big);
  }
  for (const int first : {0, 1}) {
    put<std::int32_t>(faces, 3, big);
    for (int k = 0; k < 3; ++k)
      put<std::uint16_t>(faces, static_cast<std::uint16_t>(first + k), big);
    put<std::int32_t>(faces, 5, big);
  }
  const std::string head =
      std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n";
  return faces_first ? head + face + vertex + "end_header\n" + faces + vertices
                     : head + vertex + face + "end_header\n" + vertices + faces;
}

TEST_F(Ply, BinaryInBothByteOrders) {
  for (const bool big : {false, true})
    for (const bool faces_first : {false, true}) {
      const Mesh mesh = read(binary(big, faces_first));
      EXPECT_THAT(mesh.positions,
                  ElementsAre(Vec3{0, 0, 0}, Vec3{-1, 0.5f, 1}, Vec3{-2, 1, 4}, Vec3{-3, 1.5f, 9}));
      EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2, 1, 2, 3));
    }
  EXPECT_EQ(read_ply(folder.write("b.ply", binary(true))).report.format,
            "Stanford PLY (binary, big-endian)");
  EXPECT_EQ(read_ply(folder.write("b.ply", binary(false))).report.format,
            "Stanford PLY (binary, little-endian)");
}

TEST_F(Ply, Gzip) {
  const Scene scene = read_ply(folder.write("a.ply.gz", test::gzip(kTriangle)));
  EXPECT_THAT(scene.meshes.at(0).indices, ElementsAre(0, 1, 2));
  EXPECT_EQ(scene.meshes[0].name, "a");
  EXPECT_EQ(scene.report.format, "Stanford PLY (ascii, gzip)");
  const std::string text = kTriangle;
  EXPECT_EQ(read(test::gzip(text.substr(0, 60)) + test::gzip(text.substr(60)) + "\0\0").indices,
            scene.meshes[0].indices)
      << "several members, padding";
}

TEST_F(Ply, BadGzip) {
  const std::string whole = test::gzip(kTriangle);
  EXPECT_EQ(error(whole.substr(0, 40)),
            "a.ply:40: the gzip data ends early; check whether the file is complete");
  std::string damaged = whole;
  damaged[14] = static_cast<char>(damaged[14] ^ 0x55);
  EXPECT_THAT(error(damaged), testing::HasSubstr("the gzip data is damaged ("));
  EXPECT_EQ(error(test::gzip(kTriangle + std::string(65 << 20, ' '))),
            "a.ply: expands to more than 200 times its size; decompress it first");
}

/// Larger than the pieces that threads read, so that their seams are tested.
TEST_F(Ply, LargeAsciiEqualsBinary) {
  constexpr int side = 230;
  std::string head =
      "element vertex 52900\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 52441\nproperty list uchar int vertex_indices\nend_header\n";
  std::string ascii = "ply\nformat ascii 1.0\n" + head;
  std::string bytes = "ply\nformat binary_little_endian 1.0\n" + head;
  for (int i = 0; i < side * side; ++i) {
    for (const float f : {static_cast<float>(i % side) / 3, static_cast<float>(i / side) / 7,
                          static_cast<float>(i) * 1e-7f}) {
      ascii += fmt::format("{}{}", f, i % 3 == 0 ? " " : "\t");
      put(bytes, f);
    }
    ascii += i % 1000 == 0 ? "\n \n" : "\n";
  }
  for (int y = 0; y + 1 < side; ++y)
    for (int x = 0; x + 1 < side; ++x) {
      const int a = y * side + x;
      ascii += "4";
      put<std::uint8_t>(bytes, 4);
      for (const int corner : {a, a + 1, a + side + 1, a + side}) {
        ascii += fmt::format(" {}", corner);
        put<std::int32_t>(bytes, corner);
      }
      ascii += "\n";
    }
  ASSERT_GT(ascii.size(), std::size_t{2} << 20);
  const Mesh a = read(ascii), b = read(bytes);
  EXPECT_EQ(a.triangle_count(), 2u * 52441u);
  EXPECT_TRUE(a.positions == b.positions);
  EXPECT_TRUE(a.indices == b.indices);

  const std::size_t at = ascii.size() - 5;
  ascii[at] = 'x';
  EXPECT_THAT(error(ascii), testing::StartsWith("a.ply:105403:21: an integer (vertex index)"));
}

TEST_F(Ply, BadHeaders) {
  EXPECT_EQ(error(""),
            "a.ply:1:1: this is no PLY file: it does not begin with 'ply'; check the extension");
  EXPECT_EQ(error("plywood\n"),
            "a.ply:1:1: this is no PLY file: it does not begin with 'ply'; check the extension");
  EXPECT_EQ(error("ply\nformat ascii 1.0\n"),
            "a.ply:3:1: the file ends within the PLY header; check whether the file is complete");
  EXPECT_EQ(error("ply\nend_header\n"),
            "a.ply:2:11: the PLY header has no format line; add one, format ascii 1.0 say");
  EXPECT_EQ(error_with("ascii", "utf8"),
            "a.ply:2:8: 'utf8' is no format of PLY; use ascii, binary_little_endian or "
            "binary_big_endian");
  EXPECT_EQ(error_with("float z", "half z"),
            "a.ply:7:10: 'half' is no type of PLY; use float, int, uchar or another");
  EXPECT_EQ(error_with("float z", "float"), "a.ply:7:15: the property has no name; name it");
  EXPECT_EQ(error_with("comment", "komment"),
            "a.ply:3:1: 'komment' is no line of a PLY header; check whether the file is damaged");
  EXPECT_EQ(error_with("vertex 3", "vertex -3"),
            "a.ply:4:16: an element cannot have a negative count; correct it");
  EXPECT_EQ(error_with("vertex 3", "vertex three"),
            "a.ply:4:16: an integer (count) is missing: 'three' stands there; check whether the "
            "file is damaged");
  EXPECT_EQ(error_with("element vertex 3\n", ""),
            "a.ply:4:1: a property stands before any element; move it below its element");
  EXPECT_EQ(error_with("list uchar", "list float"),
            "a.ply:9:15: the length of a list cannot be a fraction; use uchar or int");
  EXPECT_EQ(error_with("float z", "float w"),
            "a.ply: the vertices have no x, y and z; export the model again");
  EXPECT_EQ(error_with("element vertex", "element point"),
            "a.ply: has no element 'vertex'; export the model again");
  EXPECT_EQ(error_with("vertex_indices", "corners"),
            "a.ply: the faces have no list of integers 'vertex_indices'; export the model again");
  EXPECT_EQ(error_with("vertex 3", "vertex 5000000000"),
            "a.ply: declares 5000000000 vertices; split the model into files of fewer than 2^32 "
            "vertices");
}

TEST_F(Ply, BadAsciiBodies) {
  EXPECT_EQ(error_with("1.5 0 0", "1.5 0,5 0"),
            "a.ply:12:5: a number (y) is missing: '0,5' stands there; check whether the file is "
            "damaged");
  EXPECT_EQ(error_with("1.5 0 0", "1.5 0"),
            "a.ply:12:6: a number (z) is missing: the line ends; check whether the file is "
            "damaged");
  EXPECT_EQ(error_with("3 0 1 2\n", "3 0 1"),
            "a.ply:14:6: an integer (vertex index) is missing: the file ends; check whether the "
            "file is damaged");
  EXPECT_EQ(error_with("3 0 1 2", "3 0 1 3"),
            "a.ply:14:7: a face names vertex 3, and there are 3, numbered from 0; export the model "
            "again");
  EXPECT_EQ(error_with("3 0 1 2", "3 0 -1 2"),
            "a.ply:14:5: a face names vertex -1, and there are 3, numbered from 0; export the "
            "model again");
  EXPECT_EQ(error_with("3 0 1 2", "-3 0 1 2"),
            "a.ply:14:1: a list has a negative length; export the model again");
  EXPECT_EQ(error_with("vertex 3", "vertex 4000000000"),
            "a.ply:15:1: the header declares 4000000000 elements 'vertex', and only 4 lines are "
            "left for them; check whether the file is complete");
  EXPECT_EQ(error_with("face 1", "face 2"),
            "a.ply:15:1: the header declares 2 elements 'face', and only 1 lines are left for "
            "them; check whether the file is complete");
}

TEST_F(Ply, BadBinaryBodies) {
  const std::string whole = binary(false);
  const std::string start = std::to_string(whole.find("end_header\n") + 11);
  std::string many = whole;
  many.replace(many.find("vertex 4"), 8, "vertex 4000000000");
  EXPECT_EQ(error(many), "a.ply:" + std::to_string(std::stoi(start) + 9) +
                             ": the header declares 4000000000 elements 'vertex', more than the "
                             "file has bytes for; check whether the file is complete");
  EXPECT_EQ(error(whole.substr(0, whole.size() - 1)),
            "a.ply:" + std::to_string(whole.size() - 4) +
                ": the file ends before all elements that its header declares; check whether the "
                "file is complete");
  std::string corner = whole;
  corner[corner.size() - 6] = 9;
  EXPECT_EQ(error(corner), "a.ply:" + std::to_string(whole.size() - 4) +
                               ": a face names vertex 9, and there are 4, numbered from 0; export "
                               "the model again");
  std::string length = whole;
  length[length.size() - 11] = static_cast<char>(0xff);
  EXPECT_EQ(error(length), "a.ply:" + std::to_string(whole.size() - 10) +
                               ": a list has a negative length; export the model again");
}

TEST_F(Ply, MissingFile) {
  EXPECT_EQ(input_error(folder, [&] { read_ply(folder.path("none.ply")); }),
            "none.ply: cannot be read (No such file or directory); check the name and its rights");
}

}  // namespace
}  // namespace penumbra
