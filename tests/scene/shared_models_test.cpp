// Well-known models, where they are at hand.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "base/atomic_file.h"
#include "scene/finish.h"
#include "scene/load.h"
#include "scene/mesh/gunzip.h"
#include "scene/mesh_files.h"

namespace penumbra {
namespace {

struct Model {
  const char* file;
  Scene (*read)(const std::string& path);
  std::size_t triangles;
  std::size_t without_area;  ///< of these; the dragon's repeat a position
};

std::string path_of(const char* file) {
  return std::string(PENUMBRA_SHARED_DIR) + "/models/" + file;
}

void PrintTo(const Model& model, std::ostream* out) { *out << model.file; }

class SharedModel : public testing::TestWithParam<Model> {};

TEST_P(SharedModel, HasItsTriangles) {
  const std::string path = path_of(GetParam().file);
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not at hand";
  Scene scene = GetParam().read(path);
  EXPECT_EQ(test::triangles_in(scene), GetParam().triangles);
  finish_scene(scene, path);
  add_missing_camera_and_light(scene);
  EXPECT_EQ(scene.report.dropped_triangles, GetParam().without_area);
  EXPECT_EQ(test::triangles_in(scene), GetParam().triangles - GetParam().without_area);
  EXPECT_TRUE(scene.report.warnings.empty());
  EXPECT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.lights.size(), 1u);
}

INSTANTIATE_TEST_SUITE_P(Files, SharedModel,
                         testing::Values(Model{"stanford-bunny.obj", read_obj, 69451, 0},
                                         Model{"suzanne.obj", read_obj, 968, 0},
                                         Model{"spot.obj", read_obj, 5856, 0},
                                         Model{"teapot.obj", read_obj, 6320, 0},
                                         Model{"dragon_vrip_res4.ply", read_ply, 11102, 0},
                                         Model{"dragon_vrip.ply.gz", read_ply, 871414, 108}),
                         [](const auto& model) {
                           std::string name = model.param.file;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return !std::isalnum(c); },
                               '_');
                           return name;
                         });

template <class Call>
double milliseconds(const Call& call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

TEST(SharedModelTimes, Dragon) {
  const std::string compressed_path = path_of("dragon_vrip.ply.gz");
  if (!std::filesystem::exists(compressed_path))
    GTEST_SKIP() << compressed_path << " is not at hand";
  const std::string compressed = read_file(compressed_path);
  std::string text;
  const double gunzip_ms = milliseconds([&] { text = gunzip(compressed_path, compressed); });
  const test::TempFolder folder;
  const std::string path = folder.write("dragon.ply", text);
  const double read_ms = milliseconds([&] { read_file(path); });
  Scene scene;
  const double load_ms = milliseconds([&] { scene = read_ply(path); });
  const double finish_ms = milliseconds([&] { finish_scene(scene, path); });
  const double parts_ms = milliseconds([&] { connected_parts(scene.meshes.at(0)); });
  std::printf(
      "dragon: gunzip %.0f, read text %.0f, read and parse %.0f, finish %.0f, parts %.0f ms\n",
      gunzip_ms, read_ms, load_ms, finish_ms, parts_ms);
  EXPECT_LT(parts_ms, 1000);
  EXPECT_EQ(test::triangles_in(scene), 871414u - 108);
}

}  // namespace
}  // namespace penumbra
