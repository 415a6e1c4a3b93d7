// Vertex normals and textures of meshes: the shader's pictures equal the processor's.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>

#include "base/atomic_file.h"
#include "gl/driver.h"
#include "gl/pictures.h"
#include "scene/load.h"
#include "support/temporary_folder.h"

namespace penumbra {
namespace {

// A ball of few triangles with vertex normals and texture coordinates.
std::string smooth_ball() {
  constexpr int across = 12, down = 8;
  std::string text;
  for (int j = 0; j <= down; ++j)
    for (int i = 0; i <= across; ++i) {
      const double u = double(i) / across, v = double(j) / down;
      const double phi = 2 * std::numbers::pi * u, theta = std::numbers::pi * v;
      const std::string at = fmt::format("{} {} {}\n", std::sin(theta) * std::cos(phi),
                                         std::cos(theta), std::sin(theta) * std::sin(phi));
      text += "v " + at + "vn " + at + fmt::format("vt {} {}\n", 2 * u, v);
    }
  const auto corner = [](int k) { return fmt::format(" {0}/{0}/{0}", k); };
  for (int j = 0; j < down; ++j)
    for (int i = 0; i < across; ++i) {
      const int a = j * (across + 1) + i + 1, b = a + across + 1;
      if (j > 0) text += "f" + corner(a) + corner(a + 1) + corner(b + 1) + "\n";
      if (j + 1 < down) text += "f" + corner(a) + corner(b + 1) + corner(b) + "\n";
    }
  return text;
}

// A smooth pattern, so that filtering shows and rounding does not.
TextureImage pattern(int width, int height) {
  TextureImage image;
  image.width = width, image.height = height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = 2 * std::numbers::pi * x / width, v = 2 * std::numbers::pi * y / height;
      for (const double c : {0.5 + 0.4 * std::sin(3 * u), 0.5 + 0.4 * std::sin(2 * v),
                             0.5 + 0.4 * std::cos(u + v), 1.0})
        image.rgba.push_back(static_cast<std::uint8_t>(255 * c));
    }
  return image;
}

// A plain ball, a mirrored and stretched one that is a mirror in part, and a quad.
Scene scene() {
  const test::TemporaryFolder folder;
  write_file(folder / "ball.obj", smooth_ball());
  write_file(folder / "scene.json", R"({
    "camera": {"position": [1, 2, 5], "look_at": [0, 0.5, 0]},
    "materials": {"floor": {"diffuse": [0.8, 0.6, 0.4]},
                  "plain": {"diffuse": [0.7, 0.5, 0.6], "specular": [0.1, 0.1, 0.1], "roughness": 0.5},
                  "shiny": {"diffuse": [0.3, 0.4, 0.6], "mirror": 0.4}},
    "objects": [
      {"type": "quad", "corner": [-3, 0, 3], "edge_u": [6, 0, 0], "edge_v": [0, 0, -6], "material": "floor"},
      {"type": "mesh", "file": "ball.obj", "material": "plain",
       "transform": {"translate": [-0.8, 0.7, 0], "rotate_deg": [20, 30, 0], "scale": 0.7}},
      {"type": "mesh", "file": "ball.obj", "material": "shiny",
       "transform": {"translate": [0.8, 0.6, 0.2], "rotate_deg": [0, 0, 30], "scale": [-0.6, 0.4, 0.5]}},
      {"type": "sdf", "material": "floor", "root": {"shape": "sphere", "center": [0, 1.4, 0], "radius": 0.3}}],
    "lights": [{"type": "sphere", "position": [2, 4, 2], "radius": 0.4, "radiance": [20, 20, 20]}]})");
  return load_scene(folder / "scene.json");
}

RenderOptions options_of(ShadowKind kind) {
  RenderOptions options = testing::small(kind);
  options.width = 192, options.height = 128;
  options.exposure_ev = 0;
  options.shadows.light_samples = 4;
  return options;
}

class MeshPictures : public testing::GlTest {};

TEST_F(MeshPictures, VertexNormalsEqualTheProcessors) {
  for (const ShadowKind kind : {ShadowKind::none, ShadowKind::area, ShadowKind::sdf_improved})
    EXPECT_LT(testing::difference(scene(), options_of(kind)), 0.002) << testing::name_of(kind);
}

TEST_F(MeshPictures, TexturesEqualTheProcessors) {
  Scene s = scene();
  s.textures = {pattern(64, 48), pattern(512, 256), pattern(33, 7)};
  Material& floor = s.materials[s.instances[0].material];
  floor.diffuse_map.image = 1;
  floor.diffuse_map.scale = {5, 3}, floor.diffuse_map.rotation = 0.4f;
  floor.diffuse_map.wrap_s = Wrap::mirror;
  Material& plain = s.materials[s.instances[1].material];
  plain.is_metallic_roughness = true, plain.metallic = 0.6f;
  plain.diffuse_map.image = 0, plain.metallic_roughness_map.image = 2;
  Material& shiny = s.materials[s.instances[2].material];
  shiny.diffuse_map.image = 0, shiny.diffuse_map.wrap_t = Wrap::clamp;
  shiny.diffuse_map.offset = {0.3f, -0.2f}, shiny.diffuse_map.nearest = true;
  for (const ShadowKind kind : {ShadowKind::none, ShadowKind::sdf_classic})
    EXPECT_LT(testing::difference(s, options_of(kind)), 0.002) << testing::name_of(kind);
}

// Holes in a ball and in the floor, seen and casting no shadow; marches see no holes.
TEST_F(MeshPictures, CutOutsEqualTheProcessors) {
  Scene s = scene();
  s.textures = {pattern(64, 48), pattern(33, 7)};
  for (TextureImage& image : s.textures)
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) image.rgba[i + 3] = image.rgba[i + 2];
  Material& floor = s.materials[s.instances[0].material];
  floor.diffuse_map.image = 1, floor.alpha_cutoff = 0.3f;
  Material& plain = s.materials[s.instances[1].material];
  plain.diffuse_map.image = 0, plain.alpha_cutoff = 0.5f;
  plain.diffuse_map.wrap_s = Wrap::mirror;
  for (const ShadowKind kind : {ShadowKind::hard, ShadowKind::sdf_improved})
    EXPECT_LT(testing::difference(s, options_of(kind)), 0.004) << testing::name_of(kind);
}

TEST_F(MeshPictures, TexturedEmissionAndDarkBacks) {
  Scene s = scene();
  s.textures = {pattern(64, 48)};
  Material& plain = s.materials[s.instances[1].material];
  plain.emission = {0.5f, 0.6f, 0.7f}, plain.emission_map.image = 0;
  Material& floor = s.materials[s.instances[0].material];
  floor.emission = {0.3f, 0.1f, 0.1f}, floor.double_sided = false;
  const RenderOptions options = options_of(ShadowKind::none);
  EXPECT_LT(testing::difference(s, options), 0.002);
  s.cameras[0].position = {1, -2, 5};
  EXPECT_LT(testing::difference(s, options), 0.002);
}

}  // namespace
}  // namespace penumbra
