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

constexpr const char* kTwoSolids =
    "solid first one\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n"
    "   vertex 0 1 0\n  endloop\n endfacet\n facet normal 9 9 9\n  outer loop\n"
    "   vertex 1 0 0\n   vertex 1 1 0\n   vertex -0 1e0 -0\n  endloop\n endfacet\n"
    "endsolid first one\nSOLID\nFacet Normal 0 0 1\nOuter Loop\nVertex 5 0 0\nVertex 6 0 0\n"
    "Vertex 5 1 0\nEndLoop\nEndFacet\nEndSolid\n";

std::string binary(const std::string& head, std::uint32_t declared, int count) {
  std::string bytes = head;
  bytes.resize(80);
  put(bytes, declared);
  for (int i = 0; i < count; ++i) {
    const auto x = static_cast<float>(i);
    for (const float f : {9.0f, 9.0f, 9.0f, x, 0.0f, 0.0f, x + 1, 0.0f, 0.0f, x, 1.0f, 0.0f})
      put(bytes, f);
    put<std::uint16_t>(bytes, 7);
  }
  return bytes;
}

class Stl : public testing::Test {
 protected:
  Scene read(const std::string& contents) { return read_stl(folder.write("a.stl", contents)); }
  std::string error(const std::string& contents) {
    const std::string path = folder.write("a.stl", contents);
    return input_error(folder, [&] { read_stl(path); });
  }
  std::string error_with(const std::string& from, const std::string& to) {
    std::string contents = kTwoSolids;
    contents.replace(contents.find(from), from.size(), to);
    return error(contents);
  }
  TempFolder folder;
};

TEST_F(Stl, AsciiSolidsAreObjects) {
  const Scene scene = read(kTwoSolids);
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.objects.at(0).name, "first one");
  EXPECT_EQ(scene.objects.at(1).name, "a");
  EXPECT_EQ(scene.instances.at(1).object, 1u);
  EXPECT_THAT(scene.meshes[0].positions,
              ElementsAre(Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 1, 0}));
  EXPECT_THAT(scene.meshes[0].indices, ElementsAre(0, 1, 2, 1, 3, 2)) << "welded, −0 is 0";
  EXPECT_TRUE(scene.meshes[0].normals.empty());
  EXPECT_THAT(scene.meshes[1].positions, ElementsAre(Vec3{5, 0, 0}, Vec3{6, 0, 0}, Vec3{5, 1, 0}));
  EXPECT_EQ(scene.report.format, "STL (ascii)");
}

TEST_F(Stl, Binary) {
  const Scene scene = read(binary("exported", 2, 2));
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_THAT(scene.meshes[0].positions, ElementsAre(Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0},
                                                     Vec3{2, 0, 0}, Vec3{1, 1, 0}));
  EXPECT_THAT(scene.meshes[0].indices, ElementsAre(0, 1, 2, 1, 3, 4));
  EXPECT_EQ(scene.report.format, "STL (binary)");
}

TEST_F(Stl, BinaryThatBeginsWithSolid) {
  EXPECT_EQ(test::triangles_in(read(binary("solid of a careless program", 3, 3))), 3u);
  EXPECT_EQ(test::triangles_in(read(binary("solid", 3, 3) + "trailing")), 3u);
  std::string spaces = binary("solid" + std::string(75, ' '), 2, 2);
  EXPECT_EQ(test::triangles_in(read(spaces)), 2u);
}

TEST_F(Stl, BadBinary) {
  EXPECT_EQ(error(""),
            "a.stl:0: this is no STL file: it neither begins with 'solid' nor has 84 bytes; check "
            "whether the file is complete");
  EXPECT_EQ(error(binary("x", 4000000000u, 2)),
            "a.stl:184: the file ends before the 4000000000 triangles that it declares; check "
            "whether the file is complete");
}

TEST_F(Stl, BadAscii) {
  EXPECT_EQ(error_with("vertex 1 0 0", "vertex 1 0"),
            "a.stl:5:14: a number (z) is missing: the line ends; check whether the file is "
            "damaged");
  EXPECT_EQ(error_with("   vertex 0 1 0\n", ""),
            "a.stl:6:3: 'vertex' is missing: 'endloop' stands there; check whether the file is "
            "complete");
  EXPECT_EQ(error_with("endloop", "vertex 4 4 4\nendloop"),
            "a.stl:7:3: 'endloop' is missing: 'vertex' stands there; check whether the file is "
            "complete");
  EXPECT_EQ(error_with("EndSolid\n", ""),
            "a.stl:25:1: 'facet' is missing: the file ends; check whether the file is complete");
  EXPECT_EQ(error_with("SOLID", "liquid"),
            "a.stl:17:1: 'solid' is missing: 'liquid' stands there; check whether the file is "
            "complete");
}

}  // namespace
}  // namespace penumbra
