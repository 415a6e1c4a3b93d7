#include "scene/info.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "json_support.h"
#include "scene/finish.h"

namespace penumbra::test {
namespace {

using testing::HasSubstr;

TEST(Info, DescribesASceneOfEveryLight) {
  const Scene scene = read_text(R"({
    "camera": {"position": [3, 2, 4], "look_at": [0, 0.5, 0]},
    "materials": {"m": {}},
    "objects": [
      {"type": "quad", "corner": [-4, 0, 4], "edge_u": [8, 0, 0], "edge_v": [0, 0, -8], "material": "m"},
      {"type": "sphere", "center": [0, 0.5, 0], "radius": 0.5, "material": "m"},
      {"type": "box", "min": [1, 0, 0], "max": [2, 1.25, 1], "material": "m"}],
    "lights": [
      {"type": "sphere", "name": "key", "position": [1, 4, 1], "radius": 0.3, "radiance": [20, 19, 18]},
      {"type": "disk", "position": [0, 4, 0], "normal": [0, -1, 0], "radius": 0.4, "radiance": [1, 1, 1]},
      {"type": "rect", "corner": [0, 4, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, 2], "radiance": [1, 1, 1]},
      {"type": "segment", "from": [0, 4, 0], "to": [3, 4, 0], "radius": 0.01, "radiance": [1, 1, 1]},
      {"type": "point", "position": [0, 4, 0], "intensity": [5, 5, 5]},
      {"type": "sun", "direction": [0, -2, 0], "angular_diameter_deg": 6, "irradiance": [3, 3, 3]}]})");
  EXPECT_EQ(describe(scene),
            R"(format      Penumbra scene (JSON)
objects     3
meshes      2, placed 2 times
triangles   14 unique, 14 with all instances
spheres     1
bounds      (-4, 0, -4) to (4, 1.25, 4)
size        (8, 1.25, 8) m
materials   1
textures    0
ambient     (0.05, 0.05, 0.05)
background  (0, 0, 0)
lights      6
   0        sphere  "key"  at (1, 4, 1), radius 0.3 m, radiance (20, 19, 18)
   1        disk    (no name)  at (0, 4, 0), facing (0, -1, 0), radius 0.4 m, radiance (1, 1, 1)
   2        rect    (no name)  at (0.5, 4, 1), facing (0, -1, 0), 1 x 2 m, radiance (1, 1, 1)
   3        segment (no name)  at (1.5, 4, 0), 3 m along (1, 0, 0), radius 0.01 m, radiance (1, 1, 1)
   4        point   (no name)  at (0, 4, 0), intensity (5, 5, 5)
   5        sun     (no name)  towards (0, -1, 0), 6 deg wide, irradiance (3, 3, 3)
cameras     1
   0        "camera"  from (3, 2, 4) to (0, 0.5, 0), 40 deg high
)");
}

TEST(Info, MeshLight) {
  Scene scene = read_text(R"({"materials": {"glow": {"emission": [2, 2, 2]}}, "objects": [
      {"type": "box", "name": "lamp", "min": [0, 0, 0], "max": [1, 2, 3], "material": "glow"}]})");
  finish_scene(scene, "s.json");
  EXPECT_THAT(describe(scene), HasSubstr("at (0.5, 1, 1.5), 12 triangles, size (1, 2, 3) m"));
}

TEST(Info, CountsInstancesAndReportsRemarks) {
  Scene scene = read_text(with_object(
      R"({"type": "quad", "corner": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, 1], "material": "floor"})"));
  scene.instances.push_back(scene.instances[0]);
  scene.report.dropped_triangles = 7;
  scene.report.conversions = {"one", "two\nlines"};
  scene.report.warnings = {"three"};
  scene.textures.push_back({"wood.png", 640, 480, {}});
  scene.cameras.push_back({});
  scene.cameras[0].ortho_height = 2.5f;
  const std::string text = describe(scene);
  EXPECT_THAT(text, HasSubstr("meshes      1, placed 2 times\n"
                              "triangles   2 unique, 4 with all instances\n"
                              "dropped     7 triangles of zero area\n"));
  EXPECT_THAT(text, HasSubstr("textures    1\n   0        \"wood.png\"  640 x 480\n"));
  EXPECT_THAT(text, HasSubstr("orthographic, 2.5 m high\n"));
  EXPECT_THAT(text, HasSubstr("converted   one\nconverted   two lines\nwarning     three\n"));
}

TEST(Info, EmptyScene) { EXPECT_THAT(describe(Scene{}), HasSubstr("bounds      empty\n")); }

TEST(Info, Spot) {
  Scene scene;
  Light& light = scene.lights.emplace_back();
  light.normal = Vec3(0, -1, 0);
  light.spot_cos_outer = 0.5f;
  EXPECT_THAT(describe(scene), HasSubstr(", a spot along (0, -1, 0) of 120 deg\n"));
}

}  // namespace
}  // namespace penumbra::test
