// Any bytes under the mesh formats' extensions: a scene that is consistent, or an Error.
#include <gtest/gtest.h>

#include <random>

#include "scene/finish.h"
#include "scene/load.h"
#include "scene/mesh_files.h"

namespace penumbra {
namespace {

using test::put;
using test::TempFolder;

struct Format {
  const char* name;
  Scene (*read)(const std::string& path);
  std::string sample;
};

void PrintTo(const Format& format, std::ostream* out) { *out << format.name; }

std::string obj_sample() {
  return "mtllib a.mtl none.mtl\no a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0 2\nv 2 2 2\nvt 0 0\n"
         "vt 1 .5\nvn 0 0 1\nusemtl q\nf 1/1/1 2/2/1 3//1\nf 1 2 4 3\ns 1\nf 1 2 4 5 3\n"
         "f -1 -2 -3 \\\n -4\ng k\nl 1 2 3\np 1\nt crease 2/1/0 1 2 0.5\nvw 1 0 0.5\nf 1 2 3 4 5\n";
}

std::string mtl_sample() {
  return "newmtl q\nKd 0.1 0.2 0.3\nKs 1 1 1\nNs 1e3\nKe 4 5 6\nillum 3\nmap_Kd -s 1 2 -o 1 a "
         "b.png\n"
         "newmtl r\nKd .5\nmap_Ke -clamp on none.png\n";
}

std::string ply_head(const char* format) {
  return std::string("ply\nformat ") + format +
         " 1.0\ncomment c\nelement vertex 5\nproperty float x\nproperty float y\n"
         "property float z\nproperty uchar red\nproperty float nx\nproperty float ny\n"
         "property float nz\nelement edge 1\nproperty list short double w\nelement face 3\n"
         "property list uchar int vertex_indices\nend_header\n";
}

std::string ascii_ply_sample() {
  return ply_head("ascii") +
         "0 0 0 1 0 0 1\n1 0 0 2 0 0 1\n0 1 0 3 0 0 1\n1 1 0.5 4 0 1 0\n2 2 2 5 1 0 0\n2 1e3 -1\n"
         "3 0 1 2\n4 0 1 3 2\n5 0 1 4 3 2\n";
}

std::string binary_ply_sample() {
  std::string bytes = ply_head("binary_big_endian");
  for (int i = 0; i < 5; ++i) {
    for (const int f : {i % 2, i / 2, i * i}) put(bytes, static_cast<float>(f), true);
    bytes += 'r';
    for (const float f : {0.0f, 0.0f, 1.0f}) put(bytes, f, true);
  }
  put<std::int16_t>(bytes, 1, true), put(bytes, 2.5, true);
  for (const int n : {3, 4, 5}) {
    put<std::uint8_t>(bytes, static_cast<std::uint8_t>(n));
    for (int k = 0; k < n; ++k) put<std::int32_t>(bytes, k, true);
  }
  return bytes;
}

std::string ascii_stl_sample() {
  return "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
         "endloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\n"
         "vertex 0 1 0\nendloop\nendfacet\nendsolid a\nsolid b\nendsolid\n";
}

std::string binary_stl_sample() {
  std::string bytes(80, 's');
  put<std::uint32_t>(bytes, 2);
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 12; ++k) put(bytes, static_cast<float>((k * k + i) % 7));
    put<std::uint16_t>(bytes, 0);
  }
  return bytes;
}

/// All that the renderers rely on.
void expect_consistent(const Scene& scene) {
  for (const Instance& instance : scene.instances) {
    ASSERT_LT(instance.mesh, scene.meshes.size());
    ASSERT_LT(instance.material, scene.materials.size());
    ASSERT_LT(instance.object, scene.objects.size());
    ASSERT_LT(instance.mesh_light, static_cast<int>(scene.lights.size()));
  }
  for (const Mesh& mesh : scene.meshes) {
    ASSERT_EQ(mesh.indices.size() % 3, 0u);
    for (const std::uint32_t i : mesh.indices) ASSERT_LT(i, mesh.positions.size());
    ASSERT_TRUE(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
    ASSERT_TRUE(mesh.uv[0].empty() || mesh.uv[0].size() == mesh.positions.size());
  }
  for (const Material& material : scene.materials)
    ASSERT_LT(material.diffuse_map.image, static_cast<int>(scene.textures.size()));
}

class MeshRobustness : public testing::TestWithParam<Format> {
 protected:
  /// True if the bytes make a scene.
  bool load(const std::string& bytes) {
    const std::string path = folder.write("file", bytes);
    try {
      Scene scene = GetParam().read(path);
      expect_consistent(scene);
      finish_scene(scene, path);
      add_missing_camera_and_light(scene);
      expect_consistent(scene);
      return true;
    } catch (const Error& e) {
      EXPECT_EQ(std::string(e.what()).rfind(folder.path(""), 0), 0u) << e.what();
      return false;
    }
  }
  void SetUp() override { folder.write("a.mtl", mtl_sample()); }
  TempFolder folder;
};

TEST_P(MeshRobustness, TheSampleItselfLoads) { EXPECT_TRUE(load(GetParam().sample)); }

TEST_P(MeshRobustness, EveryPrefix) {
  for (std::size_t size = 0; size < GetParam().sample.size(); ++size)
    load(GetParam().sample.substr(0, size));
}

/// Overwrites, removes, doubles or inserts a little somewhere.
void mutate(std::string& bytes, std::mt19937& random) {
  constexpr std::string_view letters = "0123456789-+./ \n\\eft\xff\x7f";
  const std::size_t at = random() % (bytes.size() + 1);
  const char letter = letters[random() % letters.size()];
  const std::size_t length = 1 + random() % 9;
  switch (random() % 6) {
    case 0:
      bytes.insert(at, 1, letter);
      break;
    case 1:
      bytes.insert(at, 1, static_cast<char>(random()));
      break;
    case 2:
      bytes.erase(at, length);
      break;
    case 3:
      bytes.insert(at, bytes.substr(at, length));
      break;
    default:
      if (at < bytes.size())
        bytes[at] = random() % 2 ? letter : static_cast<char>(bytes[at] ^ (1 << random() % 8));
  }
}

TEST_P(MeshRobustness, TwoThousandMutations) {
  std::mt19937 random(1998);
  int loaded = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = GetParam().sample;
    for (auto n = 1 + random() % 4; n > 0; --n) mutate(bytes, random);
    loaded += load(bytes);
  }
  EXPECT_GT(loaded, 0) << "the mutations leave some files readable";
  EXPECT_LT(loaded, 2000) << "and break some";
}

TEST_P(MeshRobustness, RandomBytes) {
  std::mt19937 random(1997);
  for (int i = 0; i < 200; ++i) {
    std::string bytes(random() % 3000, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    EXPECT_FALSE(load(bytes));
    load(GetParam().sample.substr(0, random() % 90) + bytes);
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, MeshRobustness,
                         testing::Values(Format{"obj", read_obj, obj_sample()},
                                         Format{"ply_ascii", read_ply, ascii_ply_sample()},
                                         Format{"ply_binary", read_ply, binary_ply_sample()},
                                         Format{"ply_gzip", read_ply,
                                                test::gzip(ascii_ply_sample())},
                                         Format{"stl_ascii", read_stl, ascii_stl_sample()},
                                         Format{"stl_binary", read_stl, binary_stl_sample()}),
                         [](const auto& format) { return format.param.name; });

TEST(MtlRobustness, TwoThousandMutations) {
  TempFolder folder;
  const std::string path = folder.write("a.obj", obj_sample());
  std::mt19937 random(1996);
  int loaded = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = mtl_sample();
    for (auto n = 1 + random() % 4; n > 0; --n) mutate(bytes, random);
    folder.write("a.mtl", bytes);
    try {
      const Scene scene = read_obj(path);
      expect_consistent(scene);
      for (const Material& m : scene.materials)
        EXPECT_TRUE(is_finite(m.diffuse) && is_finite(m.emission) && m.roughness <= 1);
      ++loaded;
    } catch (const Error&) {
    }
  }
  EXPECT_GT(loaded, 0);
  EXPECT_LT(loaded, 2000);
}

}  // namespace
}  // namespace penumbra
