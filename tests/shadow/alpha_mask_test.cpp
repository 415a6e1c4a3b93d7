// Cut-out surfaces let light through their holes, in every method.
#include <gtest/gtest.h>

#include "geometry/alpha_mask.h"
#include "shadow/shadows.h"

namespace penumbra {
namespace {

constexpr int texels = 64;

// A square of 2 × 2 m at height 1 whose left half (x < 0) is a hole, under a sphere light at
// height 3.
Scene half_open_roof() {
  Scene scene;
  TextureImage image{"half", texels, texels, {}};
  for (int y = 0; y < texels; ++y)
    for (int x = 0; x < texels; ++x)
      for (int c = 0; c < 4; ++c) image.rgba.push_back(c == 3 && x < texels / 2 ? 0 : 255);
  scene.textures.push_back(image);
  Material material;
  material.alpha_cutoff = 0.5f;
  material.diffuse_map.image = 0;
  material.diffuse_map.wrap_s = material.diffuse_map.wrap_t = Wrap::clamp;
  scene.materials.push_back(material);
  scene.objects.push_back({"roof"});
  Mesh mesh;
  mesh.positions = {{-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1, 1, -1}};
  mesh.uv[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  scene.meshes.push_back(mesh);
  scene.instances.emplace_back();
  Light light;
  light.type = LightType::sphere;
  light.position = {0, 3, 0};
  light.radius = 0.3f;
  scene.lights.push_back(light);
  return scene;
}

float fraction(const World& world, ShadowKind kind, const Vec3& point) {
  ShadowOptions options;
  options.kind = kind;
  options.tolerance = 0;
  options.light_samples = 1024;
  ShadowCounts counts;
  return Shadows(world, options).visibility({point, {0, 1, 0}}, 0, 7, counts).fraction;
}

TEST(AlphaMask, EveryMethodSeesThroughTheHole) {
  const Scene scene = half_open_roof();
  const World world(scene);
  for (const ShadowKind kind : {ShadowKind::hard, ShadowKind::area, ShadowKind::parker}) {
    EXPECT_EQ(fraction(world, kind, {-0.6f, 0, 0}), 1) << "under the hole";
    EXPECT_EQ(fraction(world, kind, {0.6f, 0, 0}), 0) << "under the roof";
  }
}

TEST(AlphaMask, ParkersPenumbraBeginsAtTheTexturesEdge) {
  // The edge x = 0 at height 1 under a light at height 3: at x = −p the ray passes the edge at
  // distance 2p/3, measured across, at t = 1/3 of the way.
  const Scene scene = half_open_roof();
  const World world(scene);
  float before = 0;
  for (const float p : {0.02f, 0.08f, 0.14f, 0.2f}) {
    const float a = std::hypot(3.0f, p), clearance = (2 * p / 3) / (a / 3);
    const float tau = std::min(clearance / (0.6f / a), 1.0f);
    const float expected = tau * tau * (3 - 2 * tau);
    const float found = fraction(world, ShadowKind::parker, {-p, 0, 0.01f});
    EXPECT_NEAR(found, expected, 0.08f) << p << " tau " << tau;  // a texel is 0.03 m
    EXPECT_GT(found, before);
    before = found;
  }
}

TEST(AlphaMask, DistanceFieldIsSigned) {
  const Scene scene = half_open_roof();
  const AlphaMask mask(scene.textures[0], 1, 0.5f, Wrap::clamp, Wrap::clamp);
  EXPECT_NEAR(mask.distance(0.25f, 0.5f), 16, 0.01f);
  EXPECT_NEAR(mask.distance(0.75f, 0.5f), -16, 0.01f);
  EXPECT_NEAR(mask.distance(0.5f, 0.5f), 0, 0.01f);
}

TEST(AlphaMask, BordersAreWhatTheWrapMakesThem) {
  const Scene scene = half_open_roof();
  const TextureImage& image = scene.textures[0];
  for (const Wrap wrap : {Wrap::clamp, Wrap::mirror}) {
    const AlphaMask mask(image, 1, 0.5f, wrap, wrap);
    EXPECT_NEAR(mask.distance(0, 0.5f), 31.5f, 0.01f);
    EXPECT_NEAR(mask.distance(1, 0.5f), -31.5f, 0.01f);
  }
  const AlphaMask tiled(image, 1, 0.5f, Wrap::repeat, Wrap::repeat);
  EXPECT_NEAR(tiled.distance(0, 0.5f), 0, 0.01f) << "the next tile begins there";
  EXPECT_NEAR(tiled.distance(0.125f, 0.5f), 8, 0.01f) << "nearest in the tile before";
  EXPECT_NEAR(tiled.distance(0.875f, 0.5f), -8, 0.01f) << "nearest hole in the tile behind";
  EXPECT_NEAR(tiled.distance(0.25f, 0.5f), 15.5f, 0.01f);
}

}  // namespace
}  // namespace penumbra
