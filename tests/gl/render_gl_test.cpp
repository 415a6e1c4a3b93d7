#include "render/gl/render_gl.h"

#include <cmath>

#include "base/atomic_file.h"
#include "gl/driver.h"
#include "gl/pictures.h"
#include "image/srgb.h"
#include "scene/load.h"
#include "support/temporary_folder.h"

namespace penumbra {
namespace {

using testing::difference;
using testing::drawn_picture;
using testing::name_of;
using testing::small;

Scene shader_scene(const std::string& text) {
  const test::TemporaryFolder folder;
  const std::string file = folder / "a.glsl";
  write_file(file, text);
  return load_scene(file);
}

class RenderGl : public testing::GlTest {};

// One sample in the middle of each pixel: no partly covered pixels, whose shares differ by little.
TEST_F(RenderGl, PicturesEqualTheProcessors) {
  Progress silent;
  for (const char* name : {"table", "three-spheres"}) {
    const Scene scene =
        load_scene(std::string(PENUMBRA_SOURCE_DIR "/tests/data/oracle/") + name + ".json");
    const World world(scene, {.cone_tree = false});
    for (const ShadowKind kind : {ShadowKind::none, ShadowKind::hard, ShadowKind::area}) {
      RenderOptions options = small(kind);
      options.width = 192, options.height = 128;
      options.shadows.light_samples = 4;
      EXPECT_LT(difference(render(world, options, silent), drawn_picture(scene, options)), 0.001)
          << name << ' ' << int(kind);
    }
  }
}

// The repository's own scenes: spheres and a mirror; a sheet; a distance field among both.
TEST_F(RenderGl, LargePicturesOfOwnScenesEqualTheProcessors) {
  Progress silent;
  struct Picture {
    const char* name;
    std::vector<ShadowKind> kinds;
  };
  const Picture pictures[] = {{"figure4", {ShadowKind::hard, ShadowKind::sdf_inner}},
                              {"umbra", {ShadowKind::sdf_classic}},
                              {"mixed",
                               {ShadowKind::hard, ShadowKind::sdf_classic, ShadowKind::sdf_improved,
                                ShadowKind::sdf_inner}}};
  for (const auto& [name, kinds] : pictures) {
    const Scene scene = load_scene(std::string(PENUMBRA_SOURCE_DIR "/scenes/") + name + ".json");
    WorldOptions world_options;
    world_options.cone_tree = false, world_options.field = true;
    world_options.conversions.keep_files = false;
    const World world(scene, world_options);
    for (const ShadowKind kind : kinds) {
      RenderOptions options = small(kind);
      options.width = 480, options.height = 270;
      options.conversions.keep_files = false;
      EXPECT_LT(difference(render(world, options, silent), drawn_picture(scene, options)), 0.001)
          << name << ' ' << name_of(kind);
    }
  }
}

// A plane, and copies of a ball without end: rays end at the same place. More of the picture than
// elsewhere is silhouettes.
TEST_F(RenderGl, WhatHasNoEndEqualsTheProcessors) {
  const test::TemporaryFolder folder;
  const std::string file = folder / "scene.json";
  write_file(file, R"({
    "camera": {"position": [0.3, 7, 4], "look_at": [0, 0, 0]},
    "materials": {"m": {"diffuse": [0.8, 0.6, 0.4]}},
    "objects": [
      {"type": "sdf", "material": "m", "root": {"op": "repeat", "spacing": [2, 0, 2], "child":
        {"shape": "sphere", "center": [0, 0.5, 0], "radius": 0.4}}},
      {"type": "sdf", "material": "m", "root": {"shape": "plane", "normal": [0, 1, 0]}}],
    "lights": [{"type": "sun", "direction": [-0.4, -0.8, -0.3], "angular_diameter_deg": 6,
                "irradiance": [3, 3, 3]}],
    "background": [0.3, 0.4, 0.6]})");
  const Scene scene = load_scene(file);
  WorldOptions world_options;
  world_options.cone_tree = false, world_options.field = true;
  const World world(scene, world_options);
  Progress silent;
  for (const ShadowKind kind : {ShadowKind::hard, ShadowKind::sdf_improved}) {
    RenderOptions options = small(kind);
    options.width = 480, options.height = 270;
    EXPECT_LT(difference(render(world, options, silent), drawn_picture(scene, options)), 0.0015)
        << name_of(kind);
  }
}

// A plane to the horizon, where camera rays end on both devices.
TEST_F(RenderGl, HorizonsAreTheProcessors) {
  const test::TemporaryFolder folder;
  const std::string file = folder / "scene.json";
  write_file(file, R"({
    "camera": {"position": [0, 0.02, 5], "look_at": [0, 0.02, 0]},
    "materials": {"m": {"diffuse": [0.8, 0.6, 0.4]}},
    "objects": [{"type": "sdf", "material": "m", "root": {"shape": "plane", "normal": [0, 1, 0]}}],
    "ambient": [1, 1, 1], "background": [0, 0, 0]})");
  const Scene scene = load_scene(file);
  RenderOptions options = small(ShadowKind::none);
  options.width = 3, options.height = 3000;
  options.exposure_ev = 0;
  Progress silent;
  const World world(scene, {.cone_tree = false});
  EXPECT_LT(difference(render(world, options, silent), drawn_picture(scene, options)), 0.001);
}

// A mesh without vertex normals, whole and with a hole, beside the other objects. About the hole
// the shader knows the sign less exactly, which inner sees (mesh.glsl).
TEST_F(RenderGl, MeshesEqualTheProcessors) {
  const test::TemporaryFolder folder;
  write_file(folder / "a.obj",
             "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 1.6 0\n"
             "f 1 5 2\nf 2 5 3\nf 3 5 4\nf 4 5 1\nf 1 2 3\nf 1 3 4\n");
  write_file(folder / "b.obj",
             "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 1.6 0\nf 1 5 2\nf 2 5 3\nf 4 5 1\n");
  write_file(folder / "scene.json", R"({
    "camera": {"position": [1, 3, 5], "look_at": [0, 0.5, 0]},
    "materials": {"m": {"diffuse": [0.8, 0.6, 0.4]}},
    "objects": [
      {"type": "quad", "corner": [-4, 0, 4], "edge_u": [8, 0, 0], "edge_v": [0, 0, -8], "material": "m"},
      {"type": "mesh", "file": "a.obj", "material": "m",
       "transform": {"translate": [-0.9, 0.3, 0], "rotate_deg": [0, 30, 10], "scale": 0.7}},
      {"type": "mesh", "file": "b.obj", "material": "m",
       "transform": {"translate": [0.9, 0.1, 0.4], "rotate_deg": [0, -20, 0], "scale": [0.6, 0.7, 0.6]}},
      {"type": "sdf", "material": "m", "root": {"shape": "sphere", "center": [0, 1.3, 0.5], "radius": 0.3}}],
    "lights": [{"type": "sphere", "position": [1.5, 4, 2], "radius": 0.3, "radiance": [20, 20, 20]}]})");
  const Scene scene = load_scene(folder / "scene.json");
  WorldOptions world_options;
  world_options.cone_tree = false, world_options.field = true;
  world_options.conversions.keep_files = false;
  world_options.conversions.voxel_size = 0.05;
  const World world(scene, world_options);
  Progress silent;
  for (const ShadowKind kind :
       {ShadowKind::area, ShadowKind::sdf_improved, ShadowKind::sdf_inner}) {
    RenderOptions options = small(kind);
    options.width = 192, options.height = 128;
    options.conversions = world_options.conversions;
    options.shadows.light_samples = 4;
    EXPECT_LT(difference(render(world, options, silent), drawn_picture(scene, options)),
              kind == ShadowKind::sdf_inner ? 0.005 : 0.002)
        << name_of(kind);
  }
}

TEST_F(RenderGl, StepsAreTheProcessors) {
  const Scene scene = load_scene(PENUMBRA_SOURCE_DIR "/tests/data/oracle/three-spheres.json");
  WorldOptions world_options;
  world_options.cone_tree = false, world_options.field = true;
  const World world(scene, world_options);
  Progress silent;
  for (const ShadowKind kind :
       {ShadowKind::sdf_classic, ShadowKind::sdf_improved, ShadowKind::sdf_inner}) {
    RenderOptions options = small(kind);
    options.want_steps = true;
    const Image cpu = render(world, options, silent).steps;
    const Image gl = drawn_picture(scene, options).steps;
    ASSERT_EQ(gl.data.size(), cpu.data.size());
    double sum = 0;
    int far = 0;
    for (std::size_t i = 0; i < cpu.data.size(); ++i) {
      sum += static_cast<double>(cpu.data[i]);
      far += std::abs(cpu.data[i] - gl.data[i]) > 1;
    }
    EXPECT_GT(sum, 3.0 * static_cast<double>(cpu.data.size()));
    EXPECT_LT(far, static_cast<int>(cpu.data.size() / 100)) << name_of(kind);
  }
}

// Only distance fields have an inside: a ball and a box around the camera are rooms.
TEST_F(RenderGl, RoomsAreSeenFromWithin) {
  const test::TemporaryFolder folder;
  const std::string file = folder / "scene.json";
  write_file(file, R"({
    "camera": {"position": [0.3, 1, 1.6], "look_at": [0, 0.8, 0], "vertical_fov_deg": 70},
    "materials": {"m": {"diffuse": [0.8, 0.6, 0.4]}},
    "objects": [
      {"type": "box", "min": [-2, 0, -2], "max": [2, 2.5, 2], "material": "m"},
      {"type": "sphere", "center": [0.5, 0.4, 0], "radius": 0.4, "material": "m"}],
    "lights": [{"type": "sphere", "position": [-0.8, 2, 0.4], "radius": 0.2,
                "radiance": [20, 20, 20]}]})");
  const Scene scene = load_scene(file);
  const World world(scene, {.cone_tree = false});
  Progress silent;
  const RenderOptions options = small(ShadowKind::hard);
  EXPECT_LT(difference(render(world, options, silent), drawn_picture(scene, options)), 0.002);
}

TEST_F(RenderGl, MaterialsEqualTheProcessors) {
  const test::TemporaryFolder folder;
  const std::string file = folder / "scene.json";
  write_file(file, R"({
    "camera": {"position": [0, 2, 5], "look_at": [0, 0.4, 0]},
    "materials": {"floor": {"diffuse": [0.4, 0.5, 0.6], "specular": [0.3, 0.3, 0.3], "roughness": 0.5},
                  "gold": {"diffuse": [0.2, 0.1, 0], "specular": [0.8, 0.6, 0.2], "roughness": 0.4},
                  "chrome": {"diffuse": [0, 0, 0], "mirror": 0.9}},
    "objects": [
      {"type": "box", "min": [-4, -0.2, -4], "max": [4, 0, 4], "material": "floor"},
      {"type": "sphere", "center": [-0.7, 0.6, 0], "radius": 0.6, "material": "gold"},
      {"type": "sphere", "center": [0.7, 0.6, 0], "radius": 0.6, "material": "chrome"}],
    "lights": [
      {"type": "sphere", "position": [2, 4, 2], "radius": 0.4, "radiance": [20, 20, 20]},
      {"type": "disk", "position": [-2, 3, 1], "normal": [0.5, -1, 0], "radius": 0.5, "radiance": [9, 8, 7]},
      {"type": "rect", "corner": [0, 3, -2], "edge_u": [0.5, 0, 0], "edge_v": [0, 0.2, 0.8], "radiance": [8, 9, 8]},
      {"type": "segment", "from": [-1, 2, 2], "to": [1, 2.4, 2], "radius": 0.03, "radiance": [30, 30, 30]},
      {"type": "point", "position": [1, 2, 3], "intensity": [3, 2, 2]},
      {"type": "sun", "direction": [1, -1, -0.4], "angular_diameter_deg": 8, "irradiance": [0.5, 0.5, 0.7]}],
    "background": [0.3, 0.4, 0.6]})");
  const Scene scene = load_scene(file);
  const World world(scene, {.cone_tree = false});
  Progress silent;
  RenderOptions options = small(ShadowKind::hard);
  options.want_visibility = options.want_depth = options.want_normal = true;
  const RenderResult cpu = render(world, options, silent), gl = drawn_picture(scene, options);
  EXPECT_NEAR(gl.stats.exposure_ev, cpu.stats.exposure_ev, 0.01);
  EXPECT_LT(difference(cpu, gl), 0.002);
  int far = 0;
  for (std::size_t i = 0; i < cpu.depth.data.size(); ++i)
    far += !(cpu.depth.data[i] == gl.depth.data[i] ||
             std::abs(cpu.depth.data[i] - gl.depth.data[i]) < 1e-3f);
  for (std::size_t i = 0; i < cpu.normal.data.size(); ++i)
    far += std::abs(cpu.normal.data[i] - gl.normal.data[i]) > 0.01f;
  for (std::size_t l = 0; l < 6; ++l)
    for (std::size_t i = 0; i < cpu.depth.data.size(); ++i)
      far += cpu.visibility[l].data[i] != gl.visibility[l].data[i];
  EXPECT_LT(far, 100);  // of 10 numbers for each of 6,144 pixels
}

TEST_F(RenderGl, ExportedShadersShowTheSamePicture) {
  const Scene scene = load_scene(PENUMBRA_SOURCE_DIR "/tests/data/oracle/bridge.json");
  for (const ShadowKind kind :
       {ShadowKind::hard, ShadowKind::sdf_improved, ShadowKind::sdf_inner}) {
    const RenderOptions options = small(kind);
    const RenderResult original = drawn_picture(scene, options);
    Progress silent;
    std::vector<std::string> warnings;
    const std::string text = export_shadertoy(scene, options, "bridge.json", silent, warnings);
    EXPECT_EQ(text.find("pnb_"), std::string::npos);
    const RenderResult exported = drawn_picture(shader_scene(text), options);
    EXPECT_LT(difference(original, exported), 0.002) << int(kind);
  }
}

TEST_F(RenderGl, ExportedPersonsShadersShowTheSamePicture) {
  const Scene scene = shader_scene(
      "#define R 0.5\n#define t 3\nfloat trace(vec3 p) { return length(p - vec3(0, R, 0)) - R; }\n"
      "float map(vec3 p) { return min(p.y, trace(p)); }\n"
      "vec3 albedo(vec3 p) { return vec3(0.2, 0.5, 0.9); }\n");
  const RenderOptions options = small(ShadowKind::sdf_classic);
  Progress silent;
  std::vector<std::string> warnings;
  const std::string text = export_shadertoy(scene, options, "a.glsl", silent, warnings);
  EXPECT_LT(difference(drawn_picture(scene, options), drawn_picture(shader_scene(text), options)),
            0.002);
}

TEST_F(RenderGl, MainImageRunsAsItIs) {
  const Scene scene = shader_scene(
      "void mainImage(out vec4 c, in vec2 p) {\n"
      "  c = vec4(p.x / iResolution.x, gl_FragCoord.y == p.y ? p.y / 64.0 : 0.0, iTime / 4.0, 0);\n"
      "}\n");
  RenderOptions options = small(ShadowKind::hard);
  options.time = 1;
  const RenderResult result = drawn_picture(scene, options);
  for (const auto& [x, y] : {std::pair{0, 0}, {95, 0}, {40, 63}, {13, 37}}) {
    const float* rgb = result.color.at(x, y);
    EXPECT_NEAR(srgb_from_linear(rgb[0]), (x + 0.5) / 96, 1e-3);
    EXPECT_NEAR(srgb_from_linear(rgb[1]), (63.5 - y) / 64, 1e-3);
    EXPECT_NEAR(srgb_from_linear(rgb[2]), 0.25, 1e-3);
  }
}

TEST_F(RenderGl, LargePicturesHaveNoSeams) {
  const Scene scene = shader_scene(
      "void mainImage(out vec4 c, in vec2 p) { c = vec4(mod(p.y, 256.0) / 255.0, 0, 0, 1); }\n");
  RenderOptions options = small(ShadowKind::hard);
  options.width = 3, options.height = 3000;
  const RenderResult result = drawn_picture(scene, options);
  for (int y = 0; y < 3000; ++y)
    ASSERT_NEAR(srgb_from_linear(result.color.at(1, y)[0]) * 255,
                std::min(std::fmod(2999.5 - y, 256.0), 255.0), 0.01)
        << y;
}

TEST_F(RenderGl, ManyLightsAndSeveralSamples) {
  Scene scene = shader_scene("float map(vec3 p) { return p.y; }\n");
  Scene one = scene;
  for (Light& light : one.lights) light.emission = light.emission * 9.0f;
  scene.lights.assign(9, scene.lights[0]);
  RenderOptions options = small(ShadowKind::hard);
  options.spp = 3;
  options.exposure_ev = 0;
  scene.ambient_is_automatic = one.ambient_is_automatic = false;
  EXPECT_EQ(difference(drawn_picture(scene, options), drawn_picture(one, options)), 0);
}

}  // namespace
}  // namespace penumbra
