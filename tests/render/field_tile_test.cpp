// Pictures of distance fields alone are drawn without what their points never need. Layers of
// output need the general renderer: with one asked for, it draws the same picture.
#include "render/field_tile.h"

#include <gtest/gtest.h>

#include <fstream>

#include "render/render.h"
#include "scene/load.h"
#include "support/temporary_folder.h"

namespace penumbra {
namespace {

constexpr const char* floor_and_blend = R"({
  "camera": {"position": [3, 2.5, 4], "look_at": [0, 0.5, 0]},
  "materials": {"red": {"diffuse": [0.8, 0.2, 0.1]}, "blue": {"diffuse": [0.1, 0.3, 0.9]},
                "lamp": {"diffuse": [0, 0, 0], "emission": [2, 1.5, 1]}},
  "objects": [
    {"type": "sdf", "material": "blue", "root": {"shape": "box", "center": [0, -0.1, 0], "half_size": [3, 0.1, 3]}},
    {"type": "sdf", "material": "red", "root": {"op": "smooth_union", "k": 0.3, "children": [
      {"shape": "sphere", "center": [0, 0.5, 0], "radius": 0.5},
      {"shape": "box", "center": [0.7, 0.4, 0], "half_size": [0.4, 0.4, 0.4], "material": "blue"}]}},
    {"type": "sdf", "material": "lamp", "root": {"shape": "torus", "center": [-1.2, 0.4, 0], "major_radius": 0.4, "minor_radius": 0.1}}],
  "lights": [LIGHTS]
})";
constexpr const char* sphere_light =
    R"({"type": "sphere", "position": [1, 4, 1], "radius": 0.3, "radiance": [30, 28, 20]})";
constexpr const char* sun =
    R"({"type": "sun", "direction": [0.4, -1, -0.3], "angular_diameter_deg": 3, "irradiance": [2, 2, 3]})";
constexpr const char* rect_light =
    R"({"type": "rect", "corner": [-2, 3, -1], "edge_u": [1, 0, 0], "edge_v": [0, 0, 1], "radiance": [9, 9, 9]})";

Scene scene_with(const std::string& lights, std::string text = floor_and_blend) {
  const test::TemporaryFolder folder;
  text.replace(text.find("LIGHTS"), 6, lights);
  std::ofstream(folder / "scene.json") << text;
  return load_scene(folder / "scene.json");
}

RenderOptions options_of(ShadowKind kind, int spp) {
  RenderOptions o;
  o.width = 90, o.height = 70, o.spp = spp;
  o.exposure_ev = 0.0f;
  o.shadows.kind = kind;
  return o;
}

void expect_same_picture(const World& world, const RenderOptions& options) {
  Progress silence;
  RenderOptions with_layer = options;
  with_layer.want_depth = true;
  const RenderResult a = render(world, options, silence), b = render(world, with_layer, silence);
  ASSERT_EQ(a.color.data.size(), b.color.data.size());
  std::size_t differing = 0;
  float most = 0;
  for (std::size_t i = 0; i < a.color.data.size(); ++i) {
    differing += a.color.data[i] != b.color.data[i];
    most = std::max(most, std::abs(a.color.data[i] - b.color.data[i]));
  }
  EXPECT_EQ(differing, 0u) << "by up to " << most;
  EXPECT_EQ(a.stats.primary_rays, b.stats.primary_rays);
  EXPECT_EQ(a.stats.shadows.marches, b.stats.shadows.marches);
  EXPECT_EQ(a.stats.shadows.rays, b.stats.shadows.rays);
}

bool draws_alone(const World& world, const RenderOptions& o) {
  const Shadows shadows(world, o.shadows);
  const DirectLight lights(shadows.lights());
  const MaterialLookup materials(world.scene());
  const CameraRays camera(world.scene().cameras[0], o.width, o.height);
  return FieldTiles::of({world, o, lights, materials, shadows, camera, {}}).has_value();
}

TEST(FieldTiles, DrawsWhatTheGeneralRendererDraws) {
  for (const char* light : {sphere_light, sun, rect_light}) {
    const Scene scene = scene_with(light);
    const World world(scene, {.cone_tree = true, .field = true});
    for (const ShadowKind kind :
         {ShadowKind::none, ShadowKind::hard, ShadowKind::parker, ShadowKind::sdf_classic,
          ShadowKind::sdf_improved, ShadowKind::sdf_inner}) {
      SCOPED_TRACE(testing::Message() << light << " by method " << static_cast<int>(kind));
      const RenderOptions options = options_of(kind, 2);
      EXPECT_TRUE(draws_alone(world, options));
      expect_same_picture(world, options);
    }
  }
}

TEST(FieldTiles, DrawsSeveralLightsAndASkyTheSame) {
  const Scene scene = scene_with(std::string(sphere_light) + ", " + sun + ", " + rect_light);
  const World world(scene, {.cone_tree = false, .field = true});
  expect_same_picture(world, options_of(ShadowKind::sdf_classic, 3));
}

TEST(FieldTiles, LeavesTheRestToTheGeneralRenderer) {
  const Scene scene = scene_with(sphere_light);
  const World world(scene, {.cone_tree = false, .field = true});
  EXPECT_FALSE(draws_alone(world, options_of(ShadowKind::area, 1)));
  for (const char* shiny : {R"("mirror": 0.5)", R"("specular": [0.04, 0.04, 0.04])"}) {
    std::string text = floor_and_blend;
    text.replace(text.find("\"diffuse\": [0, 0, 0]"), 20, shiny);
    const Scene other = scene_with(sphere_light, text);
    const World shiny_world(other, {.cone_tree = false, .field = true});
    EXPECT_FALSE(draws_alone(shiny_world, options_of(ShadowKind::sdf_classic, 1))) << shiny;
  }
  std::string text = floor_and_blend;
  text.replace(text.find("{\"type\": \"sdf\", \"material\": \"lamp\""), 0,
               R"({"type": "sphere", "center": [0, 2, 0], "radius": 0.2, "material": "red"},)");
  const Scene mixed = scene_with(sphere_light, text);
  const World mixed_world(mixed, {.cone_tree = false, .field = true});
  EXPECT_FALSE(draws_alone(mixed_world, options_of(ShadowKind::sdf_classic, 1)));
}

TEST(FieldTiles, ShowsNothingFromWithinASolid) {
  Scene scene = scene_with(sphere_light);
  scene.cameras[0].position = {0, 0.5f, 0};
  const World world(scene, {.cone_tree = false, .field = true});
  EXPECT_FALSE(draws_alone(world, options_of(ShadowKind::sdf_classic, 1)));
}

}  // namespace
}  // namespace penumbra
