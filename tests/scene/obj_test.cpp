#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/finish.h"
#include "scene/load.h"
#include "scene/mesh_files.h"

namespace penumbra {
namespace {

using test::input_error;
using test::put;
using test::TempFolder;
using testing::ElementsAre;

const std::string kVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0 1.0\n";

/// A 1×1 TGA picture, true colour without compression.
std::string tga_pixel() {
  std::string bytes("\0\0\2\0\0\0\0\0\0\0\0\0", 12);
  put<std::uint16_t>(bytes, 1), put<std::uint16_t>(bytes, 1);
  bytes += std::string("\x18\x20", 2);
  return bytes + std::string("\x01\x02\x03", 3);  // blue, green, red
}

class Obj : public testing::Test {
 protected:
  Scene read(const std::string& contents) { return read_obj(folder.write("a.obj", contents)); }
  Mesh mesh(const std::string& contents) { return read(contents).meshes.at(0); }
  /// The error for a face after kVertices, in line 5.
  std::string face_error(const std::string& line) {
    const std::string path = folder.write("a.obj", kVertices + line);
    return input_error(folder, [&] { read_obj(path); });
  }
  Material material(const std::string& mtl) {
    folder.write("a.mtl", "newmtl m\n" + mtl);
    return read("mtllib a.mtl\nusemtl m\n" + kVertices + "f 1 2 3\n").materials.at(0);
  }
  TempFolder folder;
};

TEST_F(Obj, TrianglesWithNegativeNumbersAndComments) {
  const Scene scene = read("# a comment\n\n" + kVertices +
                           "f 1 2 3\r\nf -4/ -2// -1//\nf \\\n 1 \\\r\n 2 4 # last\ns off\n");
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_THAT(scene.meshes[0].positions,
              ElementsAre(Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}));
  EXPECT_THAT(scene.meshes[0].indices, ElementsAre(0, 1, 2, 0, 2, 3, 0, 1, 3));
  EXPECT_TRUE(scene.meshes[0].normals.empty());
  EXPECT_TRUE(scene.meshes[0].uv[0].empty());
  EXPECT_EQ(scene.objects.at(0).name, "a");
  EXPECT_EQ(scene.materials.at(0).name, "default");
  EXPECT_TRUE(scene.report.warnings.empty());
  EXPECT_EQ(scene.report.format, "Wavefront OBJ");
}

TEST_F(Obj, FacesMayComeFirst) {
  EXPECT_THAT(mesh("f 1 2 3\n" + kVertices).indices, ElementsAre(0, 1, 2));
}

TEST_F(Obj, ConcavePolygon) {
  const Mesh m = mesh("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 .5 0\nv 0 2 0\nf 1 2 3 4 5\nf 5 4 3 2 1\n");
  EXPECT_EQ(m.triangle_count(), 6u);
  Mesh half = m;
  half.indices.resize(9);
  EXPECT_NEAR(test::area_vector(half).z, 2 * 2.5, 1e-6);
  EXPECT_NEAR(test::area_vector(m).z, 0, 1e-6);
  half.indices.assign(m.indices.begin(), m.indices.begin() + 3);
  for (int i = 0; i < 3; ++i) {
    half.indices.assign(m.indices.begin() + 3 * i, m.indices.begin() + 3 * i + 3);
    EXPECT_GT(test::area_vector(half).z, 0) << "no triangle turned over";
  }
}

TEST_F(Obj, AttributesShareVertices) {
  const Mesh m = mesh(kVertices +
                      "vt 0 0\nvt 1 0.25\nvt .5\nvn 0 0 1\nvn 1 0 0\n"
                      "f 1/1/1 2/2/1 3/3/2\nf 1/1/1 3/3/2 4/1/1\nf 1/1/2 2/2/1 4/1/1\n");
  EXPECT_EQ(m.positions.size(), 5u) << "vertex 1 with two normals";
  EXPECT_THAT(m.indices, ElementsAre(0, 1, 2, 0, 2, 3, 4, 1, 3));
  EXPECT_EQ(m.uv[0].at(1).x, 1);
  EXPECT_EQ(m.uv[0].at(1).y, 0.75f) << "the first row of a texture is the top";
  EXPECT_EQ(m.uv[0].at(2).y, 1);
  EXPECT_THAT(m.normals, ElementsAre(Vec3{0, 0, 1}, Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0, 0, 1},
                                     Vec3{1, 0, 0}));
}

TEST_F(Obj, MissingNormalsAreThoseOfTheTriangles) {
  Scene scene = read(kVertices + "vn 1 0 0\nf 1//1 2 3\n");
  finish_scene(scene, "a.obj");
  EXPECT_THAT(scene.meshes[0].normals, ElementsAre(Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, 0, 1}));
}

TEST_F(Obj, GroupsAndMaterialsMakeObjectsAndMeshes) {
  folder.write("m.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  const Scene scene = read("mtllib m.mtl\n" + kVertices +
                           "f 1 2 3\no chair\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 3 4\n"
                           "g leg\nf 2 3 4\no chair\nusemtl red\nf 2 3 4\n");
  std::vector<std::string> names;
  for (const Object& o : scene.objects) names.push_back(o.name);
  EXPECT_THAT(names, ElementsAre("a", "chair", "chair/leg"));
  ASSERT_EQ(scene.instances.size(), 4u);
  std::vector<std::string> rows;
  for (const Instance& i : scene.instances)
    rows.push_back(names[i.object] + " " + scene.materials[i.material].name + " " +
                   std::to_string(scene.meshes[i.mesh].triangle_count()));
  EXPECT_THAT(rows, ElementsAre("a default 1", "chair red 2", "chair blue 1", "chair/leg blue 1"));
}

TEST_F(Obj, MaterialValues) {
  const Material m = material("Kd 0.1 .2 2\nKs 0.5 0.5 0.5\nNs 30\nKe 4 5 6\nillum 2\n");
  EXPECT_EQ(m.name, "m");
  EXPECT_EQ(m.diffuse, (Vec3{0.1f, 0.2f, 1}));
  EXPECT_NEAR(m.specular.x, 0.04, 1e-6);
  EXPECT_NEAR(m.roughness * m.roughness, 0.25, 1e-6);  // α = √(2 / 32)
  EXPECT_EQ(m.emission, (Vec3{4, 5, 6}));
  EXPECT_EQ(m.mirror, (Vec3{}));
  EXPECT_EQ(material("Kd 0.3\n").diffuse, (Vec3{0.3f, 0.3f, 0.3f}));
  EXPECT_EQ(material("Kd spectral a.rfl\n").diffuse, (Vec3{0.8f, 0.8f, 0.8f}));
  EXPECT_EQ(material("Kd -1 nan inf\nKe nan inf 1\nNs -5\n").diffuse, (Vec3{0, 0, 1}));
  EXPECT_EQ(material("Ke nan inf 1\n").emission, (Vec3{0, 0, 1}));
}

TEST_F(Obj, IlluminationModelMakesMirrors) {
  const Material m = material("Kd 0.5 0.5 0.5\nKs 0.9 0.8 0.8\nillum 3\n");
  EXPECT_EQ(m.mirror, (Vec3{0.9f, 0.8f, 0.8f}));
  EXPECT_NEAR(m.diffuse.x, 0.05, 1e-6);
  EXPECT_EQ(m.specular, (Vec3{}));
  EXPECT_EQ(material("Ks 0.2 0.2 0.2\nillum 3\n").mirror, (Vec3{}));
}

TEST_F(Obj, Textures) {
  folder.write("my pixel.tga", tga_pixel());
  folder.write("a.mtl",
               "newmtl m\nKd 0 0 0\nmap_Kd -s 2 3 1 -o 0.25 0.5 -bm 1 -clamp on my pixel.tga\n"
               "map_Ke my pixel.tga\nnewmtl n\nmap_Kd none.png\nmap_Ke .\\broken.png\n");
  folder.write("broken.png", "not a picture");
  const Scene scene = read("mtllib a.mtl\n" + kVertices + "usemtl m\nf 1 2 3\nusemtl n\nf 1 3 4\n");
  ASSERT_EQ(scene.textures.size(), 2u);
  EXPECT_EQ(scene.textures[0].rgba, (std::vector<std::uint8_t>{3, 2, 1, 255}));
  const TextureSlot& slot = scene.materials.at(0).diffuse_map;
  EXPECT_EQ(slot.image, 0);
  EXPECT_EQ(slot.wrap_s, Wrap::clamp);
  EXPECT_EQ(slot.scale.x, 2);
  EXPECT_EQ(slot.scale.y, 3);
  EXPECT_EQ(slot.offset.x, 0.25f);
  // At v = 0.1 in the file: 0.1 · 3 + 0.5 = 0.8, which is 0.2 from the top.
  EXPECT_NEAR((1 - 0.1f) * slot.scale.y + slot.offset.y, 0.2, 1e-6);
  EXPECT_EQ(scene.materials[0].diffuse, (Vec3{1, 1, 1})) << "Kd 0 beside a texture is no colour";
  EXPECT_EQ(scene.materials[0].emission_map.image, 0);
  EXPECT_EQ(scene.materials[0].emission, (Vec3{1, 1, 1}));
  EXPECT_FALSE(scene.materials.at(1).diffuse_map.used());
  ASSERT_EQ(scene.report.warnings.size(), 2u);
  EXPECT_THAT(scene.report.warnings[0], testing::EndsWith("cannot be read: left out"));
  EXPECT_THAT(scene.report.warnings[1], testing::EndsWith("cannot be decoded: white"));
}

TEST_F(Obj, MissingLibraryAndMaterials) {
  folder.write("m.mtl", "newmtl red\n");
  Scene scene = read("mtllib m.mtl none.mtl\nusemtl green\n" + kVertices +
                     "f 1 2 3\nusemtl red\n"
                     "f 1 2 3\nusemtl green\nf 1 3 4\n");
  EXPECT_THAT(scene.report.warnings,
              ElementsAre("the material library 'none.mtl' cannot be read: its materials are the "
                          "default",
                          "there is no material 'green': the default is used"));
  EXPECT_EQ(scene.materials.at(scene.instances.at(0).material).name, "default");
  scene = read("mtllib /dev/zero\n" + kVertices + "f 1 2 3\n");
  EXPECT_EQ(scene.report.warnings.size(), 1u) << "a device is no library";
}

TEST_F(Obj, BadMaterialNumbers) {
  folder.write("bad.mtl", "newmtl m\nKd 1 red 0\n");
  const std::string path = folder.write("a.obj", "mtllib bad.mtl\n" + kVertices + "f 1 2 3\n");
  EXPECT_EQ(input_error(folder, [&] { read_obj(path); }),
            "bad.mtl:2:6: a number (green) is missing: 'red' stands there; check whether the file "
            "is damaged");
}

TEST_F(Obj, WhatIsNotRenderedIsReported) {
  const Scene scene =
      read(kVertices + "l 1 2\np 1\nf 1 2 3\ncurv2 1 2\nfoo\nt x 2000000000/9/9\nbar\n");
  EXPECT_THAT(scene.report.warnings,
              ElementsAre("2 lines are not understood, first 'foo' in line 9",
                          "3 lines, points, curves or surfaces were left out: only faces are "
                          "rendered"));
}

TEST_F(Obj, BadFaces) {
  EXPECT_EQ(face_error("f 1 2 5\n"),
            "a.obj:5:1: a face names vertex 5, and there are 4; export the model again");
  EXPECT_EQ(face_error("f 1 2 -5\n"),
            "a.obj:5:7: a face names vertex -5, and there are 4; export the model again");
  EXPECT_EQ(face_error("f 1/1 2 3\n"),
            "a.obj:5:1: a face names texture coordinate 1, and there are 0; export the model "
            "again");
  EXPECT_EQ(face_error("f 1//-1 2 3\n"),
            "a.obj:5:6: a face names normal -1, and there are 0; export the model again");
  EXPECT_EQ(face_error("f 1 2 0\n"),
            "a.obj:5:7: a face names number 0, and numbers begin with 1; correct it");
  EXPECT_EQ(face_error("f 1 2 5000000000\n"),
            "a.obj:5:7: a face names vertex 5000000000, and there are 4; export the model again");
  EXPECT_EQ(face_error("f 1 2 99999999999999999999\n"),
            "a.obj:5:7: an integer (vertex) is missing: '99999999999999999999' stands there; check "
            "whether the file is damaged");
  EXPECT_EQ(face_error("f 1 2 -9223372036854775808\n"),
            "a.obj:5:7: a face names vertex -9223372036854775808, and there are 4; export the "
            "model again");
  EXPECT_EQ(face_error("f 1 2\n"), "a.obj:5:1: a face has 2 corners; give it three or more");
  EXPECT_EQ(face_error("f 1 2 3.5\n"),
            "a.obj:5:8: the corner of a face is not written v/vt/vn; correct it");
  EXPECT_EQ(face_error("v 1 2\nf 1 2 3"),
            "a.obj:5:6: a number (z) is missing: the line ends; check whether the file is "
            "damaged");
}

TEST_F(Obj, FileWithoutFacesIsRefused) {
  Scene scene = read(kVertices);
  EXPECT_EQ(input_error(folder, [&] { finish_scene(scene, folder.path("a.obj")); }),
            "a.obj: contains no triangle and no sphere; name a file with something to render");
}

}  // namespace
}  // namespace penumbra
