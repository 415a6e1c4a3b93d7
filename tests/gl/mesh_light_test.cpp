// Emissive surfaces as lights: the shader's pictures and fractions equal the processor's.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/atomic_file.h"
#include "gl/driver.h"
#include "gl/pictures.h"
#include "scene/load.h"
#include "shadow/shadows.h"
#include "support/temporary_folder.h"

namespace penumbra {
namespace {

// A torus of 2 · across · down triangles, which winds around itself: some of it is always turned
// away.
std::string ring(int across, int down) {
  std::string text;
  const auto angle = [](int i, int n) { return i * 2 * std::numbers::pi / n; };
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < down; ++j) {
      const double u = angle(i, across), v = angle(j, down), r = 0.4 + 0.15 * std::cos(v);
      text += fmt::format("v {} {} {}\n", r * std::cos(u), 0.15 * std::sin(v), r * std::sin(u));
    }
  const auto at = [&](int i, int j) { return i % across * down + j % down + 1; };
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < down; ++j) {
      text += fmt::format("f {} {} {}\n", at(i, j), at(i, j + 1), at(i + 1, j + 1));
      text += fmt::format("f {} {} {}\n", at(i, j), at(i + 1, j + 1), at(i + 1, j));
    }
  return text;
}

Scene scene_with(const std::string& lamps) {
  const test::TemporaryFolder folder;
  write_file(folder / "ring.obj", ring(12, 8));
  write_file(folder / "sheet.obj",
             "v -0.4 0 -0.3\nv 0.4 0.1 -0.3\nv 0.4 0 0.3\nv -0.4 0.1 0.3\nf 1 2 3\nf 1 3 4\n");
  write_file(folder / "scene.json", R"({
    "camera": {"position": [1, 2, 5], "look_at": [0, 0.9, 0]},
    "materials": {"m": {"diffuse": [0.8, 0.6, 0.4], "specular": [0.2, 0.2, 0.2], "roughness": 0.4},
                  "lamp": {"diffuse": [0, 0, 0], "emission": [9, 8, 7]}},
    "objects": [
      {"type": "quad", "corner": [-3, 0, 3], "edge_u": [6, 0, 0], "edge_v": [0, 0, -6], "material": "m"},
      {"type": "quad", "corner": [-3, 3, -3], "edge_u": [6, 0, 0], "edge_v": [0, 0, 6], "material": "m"},
      {"type": "box", "min": [-1.2, 0, -0.4], "max": [-0.5, 0.8, 0.3], "material": "m"},
      {"type": "sdf", "material": "m", "root": {"shape": "sphere", "center": [0.5, 0.5, 0], "radius": 0.4}},)" +
                                        lamps + "]}");
  return load_scene(folder / "scene.json");
}

constexpr const char* kCeiling =
    R"({"type": "quad", "corner": [-0.6, 3, -0.5], "edge_u": [1, 0, 0], "edge_v": [0, 0, 0.9], "material": "lamp"})";
constexpr const char* kBox =
    R"({"type": "box", "min": [0.9, 1.6, -0.2], "max": [1.3, 2, 0.5], "material": "lamp"})";
constexpr const char* kRing =
    R"({"type": "mesh", "file": "ring.obj", "material": "lamp", "transform": {"translate": [0, 2, 0.4], "rotate_deg": [30, 0, 20]}})";
constexpr const char* kSheet =
    R"({"type": "mesh", "file": "sheet.obj", "material": "lamp", "transform": {"translate": [0, 1.9, 0.4]}})";

class MeshLights : public testing::GlTest {};

TEST_F(MeshLights, PicturesEqualTheProcessors) {
  for (const char* lamp : {kCeiling, kBox, kRing, kSheet}) {
    const Scene scene = scene_with(lamp);
    ASSERT_EQ(scene.lights.size(), 1u);
    ASSERT_EQ(scene.lights[0].type, LightType::mesh);
    for (const ShadowKind kind : {ShadowKind::hard, ShadowKind::area, ShadowKind::sdf_inner}) {
      RenderOptions options = testing::small(kind);
      options.width = 144, options.height = 96;
      options.exposure_ev = 0;
      options.shadows.light_samples = 4;
      EXPECT_LT(testing::difference(scene, options), 0.001)
          << lamp << ' ' << testing::name_of(kind);
    }
  }
}

TEST_F(MeshLights, ExportedShadersShowTheSamePicture) {
  const Scene scene = scene_with(kBox);
  const RenderOptions options = testing::small(ShadowKind::hard);
  Progress silent;
  std::vector<std::string> warnings;
  const test::TemporaryFolder folder;
  write_file(folder / "a.glsl", export_shadertoy(scene, options, "scene.json", silent, warnings));
  EXPECT_LT(testing::difference(testing::drawn_picture(scene, options),
                                testing::drawn_picture(load_scene(folder / "a.glsl"), options)),
            0.002);
}

// A lamp in the ceiling's own plane is not hidden by it.
TEST_F(MeshLights, CeilingsDoNotHideTheirLamps) {
  Scene scene = scene_with(kCeiling);
  Light rect;
  rect.type = LightType::rect;
  rect.position = {0, 3, 0}, rect.normal = {0, -1, 0};
  rect.edge_u = {0.8f, 0, 0}, rect.edge_v = {0, 0, 0.8f};
  scene.lights.push_back(rect);
  RenderOptions options;
  options.conversions.keep_files = false;
  options.shadows.light_samples = 16;
  for (const ShadowKind kind : {ShadowKind::hard, ShadowKind::area}) {
    options.shadows.kind = kind;
    const std::vector<ProbeQuery> queries{{{{1.5f, 0, 1}, {0, 1, 0}}, 0},
                                          {{{1.5f, 0, 1}, {0, 1, 0}}, 1}};
    Progress silent;
    for (const float seen : probe_gl(scene, options, queries, silent).fractions)
      EXPECT_EQ(seen, 1) << testing::name_of(kind);
  }
}

TEST_F(MeshLights, FractionsEqualTheProcessors) {
  const Scene scene = scene_with(std::string(kBox) + ", " + kRing);
  ASSERT_EQ(scene.lights.size(), 2u);
  WorldOptions world_options;
  world_options.cone_tree = false;
  world_options.conversions.keep_files = false;
  const World world(scene, world_options);
  RenderOptions options;
  options.conversions = world_options.conversions;
  options.shadows.kind = ShadowKind::area;
  options.shadows.light_samples = 256;
  const Shadows shadows(world, options.shadows);
  std::vector<ProbeQuery> queries;
  std::vector<float> expected;
  ShadowCounts counts;
  for (int i = 0; i < 200; ++i) {
    const float x = -2 + 0.2f * static_cast<float>(i % 20);
    const float z = -1 + 0.2f * static_cast<float>(i / 20);
    for (std::size_t light = 0; light < 2; ++light) {
      queries.push_back({{{x, 0, z}, {0, 1, 0}}, light});
      expected.push_back(
          shadows.visibility(queries.back().receiver, light, queries.size() - 1, counts).fraction);
    }
  }
  Progress silent;
  const std::vector<float> found = probe_gl(scene, options, queries, silent).fractions;
  double sum = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    sum += std::pow(static_cast<double>(found[i] - expected[i]), 2);
  EXPECT_LT(std::sqrt(sum / static_cast<double>(found.size())), 0.005);
}

}  // namespace
}  // namespace penumbra
