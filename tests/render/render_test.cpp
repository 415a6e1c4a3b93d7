#include "render/render.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/error.h"
#include "base/parallel.h"
#include "render/small_scenes.h"

namespace penumbra {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

RenderOptions small_options(ShadowKind kind, int width = 64, int height = 48) {
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.spp = 1;
  options.shadows.kind = kind;
  options.exposure_ev = 0.0f;
  return options;
}

RenderResult picture(const Scene& scene, const RenderOptions& options) {
  Progress progress;
  return render(World(scene), options, progress);
}

Vec3 color_at(const RenderResult& result, int x, int y) {
  const float* c = result.color.at(x, y);
  return {c[0], c[1], c[2]};
}

TEST(Render, ASphereProjectsWhereItMust) {
  Scene scene;
  Material glowing = diffuse_material({0, 0, 0});
  glowing.emission = {1, 2, 3};
  add_sphere(scene, {1, 0.5f, 0}, 0.2f, add_material(scene, glowing));
  add_camera(scene, {0, 0, 4}, {0, 0, 0}, 2 * std::atan(0.5f));
  const RenderResult result = picture(scene, small_options(ShadowKind::none, 200, 100));
  // At distance 4 a metre is 25 pixels: the centre is at (125, 37.5).
  EXPECT_EQ(color_at(result, 125, 37), (Vec3{1, 2, 3}));
  double x = 0, y = 0, count = 0;
  for (int j = 0; j < 100; ++j)
    for (int i = 0; i < 200; ++i)
      if (color_at(result, i, j).x > 0) x += i + 0.5, y += j + 0.5, count += 1;
  EXPECT_NEAR(x / count, 125, 0.3);
  EXPECT_NEAR(y / count, 37.5, 0.3);
  EXPECT_NEAR(count, pi * 25, 6);
}

TEST(Render, TheFloorUnderASphereLightHasItsClosedRadiance) {
  Scene scene;
  add_floor(scene, add_material(scene, diffuse_material(Vec3(0.5f))));
  add_sphere_light(scene, {0, 2, 0}, 0.5f, 10);
  add_camera(scene, {0.01f, 1, 0}, {0, 0, 0}, 0.01f);
  scene.ambient = Vec3(0.1f);
  for (ShadowKind kind : {ShadowKind::none, ShadowKind::hard, ShadowKind::area}) {
    const RenderResult result = picture(scene, small_options(kind, 3, 3));
    EXPECT_NEAR(color_at(result, 1, 1).x, 0.5f * 10 / 16 + 0.05f, 1e-3f);
  }
}

TEST(Render, InAClosedGlowingBoxEverythingReflectsAndEmits) {
  // Each wall shows its emission, what it reflects of the other five (a wall is no mesh light here,
  // so that only ambient light of the walls' own radiance stands for them), and mirrors the rest:
  // with albedo ρ, mirror μ and radiance L = e + ρ a + μ L to depth k.
  Scene scene;
  Material wall = diffuse_material(Vec3(0.4f));
  wall.mirror = Vec3(0.5f);
  wall.emission = Vec3(1.0f);
  const auto m = add_material(scene, wall);
  for (float side : {-1.0f, 1.0f}) {
    add_quad(scene, {side, -1, -1}, {0, 2, 0}, {0, 0, 2}, m);
    add_quad(scene, {-1, side, -1}, {2, 0, 0}, {0, 0, 2}, m);
    add_quad(scene, {-1, -1, side}, {2, 0, 0}, {0, 2, 0}, m);
  }
  add_camera(scene, {0.1f, 0.2f, 0.3f}, {1, 0.4f, -0.2f}, 1.5f);
  scene.ambient = Vec3(2.0f);
  for (int depth : {0, 1, 6}) {
    RenderOptions options = small_options(ShadowKind::hard);
    options.mirror_depth = depth;
    const RenderResult result = picture(scene, options);
    const float own = 1 + 0.4f * 2, expected = own * (2 - std::pow(0.5f, float(depth)));
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 64; ++x) ASSERT_NEAR(color_at(result, x, y).x, expected, 1e-4f);
    EXPECT_EQ(result.stats.mirror_rays, 64u * 48u * static_cast<unsigned>(depth));
  }
}

TEST(Render, AMirrorShowsTheEmissiveQuadBehindTheCamera) {
  Scene scene;
  Material mirror = diffuse_material({0, 0, 0}), lamp = diffuse_material({0, 0, 0});
  mirror.mirror = {0.9f, 0.8f, 0.7f};
  lamp.emission = {2, 3, 4};
  add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, add_material(scene, mirror));
  add_quad(scene, {-1, -1, 3}, {2, 0, 0}, {0, 2, 0}, add_material(scene, lamp));
  add_camera(scene, {0, 0, 1}, {0, 0, 0}, 0.2f);
  const Vec3 c = color_at(picture(scene, small_options(ShadowKind::none)), 32, 24);
  EXPECT_NEAR(c.x, 1.8f, 1e-5f);
  EXPECT_NEAR(c.y, 2.4f, 1e-5f);
  EXPECT_NEAR(c.z, 2.8f, 1e-5f);
}

TEST(Render, SameBytesAtAnyThreadCountAndAgain) {
  const Scene scene = still_life();
  for (ShadowKind kind : {ShadowKind::hard, ShadowKind::area}) {
    RenderOptions options = small_options(kind, 100, 70);
    options.spp = 3;
    options.seed = 5;
    options.want_visibility = options.want_error = true;
    std::vector<RenderResult> results;
    for (int threads : {1, 2, 2}) {
      const ThreadLimit limit(threads);
      results.push_back(picture(scene, options));
    }
    for (std::size_t i : {1, 2}) {
      EXPECT_EQ(results[0].color.data, results[i].color.data);
      EXPECT_EQ(results[0].visibility[0].data, results[i].visibility[0].data);
      EXPECT_EQ(results[0].error.data, results[i].error.data);
      EXPECT_EQ(results[0].stats.shadows.rays, results[i].stats.shadows.rays);
    }
  }
}

TEST(Render, ScaleChangesNoRadiance) {
  const RenderOptions options = small_options(ShadowKind::none);
  const RenderResult one = picture(still_life(), options);
  for (float scale : {0.01f, 100.0f}) {
    const RenderResult other = picture(still_life(scale), options);
    std::size_t different = 0;
    for (std::size_t i = 0; i < one.color.data.size(); ++i)
      different += std::abs(one.color.data[i] - other.color.data[i]) > 1e-3f;
    EXPECT_LE(different, 6u) << "only silhouette pixels may flip";
  }
}

TEST(Render, ExposureIsTheSameForEveryMethodAndSize) {
  const Scene scene = still_life();
  RenderOptions options = small_options(ShadowKind::none);
  options.exposure_ev = {};
  const float ev = picture(scene, options).stats.exposure_ev;
  EXPECT_NE(ev, 0);
  for (ShadowKind kind : {ShadowKind::hard, ShadowKind::area}) {
    options.shadows.kind = kind;
    options.width = 20;
    options.spp = 2;
    EXPECT_EQ(picture(scene, options).stats.exposure_ev, ev);
  }
}

TEST(Render, ExposureShowsLitSurfacesBrightAndFollowsTheLight) {
  Scene scene = still_life();
  scene.background = Vec3(100.0f);
  RenderOptions options = small_options(ShadowKind::hard);
  options.exposure_ev = {};
  const float ev = picture(scene, options).stats.exposure_ev;
  scene.lights[0].emission = scene.lights[0].emission * 4;
  scene.ambient = scene.ambient * 4;
  EXPECT_NEAR(picture(scene, options).stats.exposure_ev, ev - 2, 1e-4f);
  EXPECT_NEAR(picture(still_life(100), options).stats.exposure_ev, ev, 0.02f);
  options.exposure_ev = 1.5f;
  EXPECT_EQ(picture(scene, options).stats.exposure_ev, 1.5f);
}

TEST(Render, OtherChannelsSayWhatThePixelSees) {
  Scene scene;
  add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0},
           add_material(scene, diffuse_material(Vec3(0.5f))));
  add_sphere(scene, {0.5f, 0.5f, 1.5f}, 0.4f, 0);  // stands in the light, not in the view
  add_sphere_light(scene, {0.5f, 0.5f, 3}, 0.1f, 10);
  add_sphere_light(scene, {0, 0, -3}, 0.1f, 10);
  add_camera(scene, {0, 0, 2}, {0, 0, 0}, 2 * std::atan(1.0f));
  RenderOptions options = small_options(ShadowKind::hard, 40, 40);
  options.want_visibility = options.want_depth = options.want_normal = options.want_error = true;
  const RenderResult result = picture(scene, options);
  ASSERT_EQ(result.visibility.size(), 2u);
  EXPECT_EQ(*result.visibility[0].at(12, 28), 1) << "lit";
  EXPECT_EQ(*result.visibility[0].at(24, 15), 0) << "behind the sphere, or on its dark side";
  EXPECT_EQ(*result.visibility[1].at(12, 28), 0) << "the second light is behind the quad";
  EXPECT_EQ(*result.visibility[1].at(0, 39), 1) << "background";
  EXPECT_NEAR(*result.depth.at(19, 20), 2, 0.01f);
  EXPECT_TRUE(std::isinf(*result.depth.at(0, 39)));
  EXPECT_NEAR(result.normal.at(12, 28)[2], 1, 1e-6f);
  EXPECT_EQ(result.normal.at(0, 39)[2], 0);
  EXPECT_EQ(*result.error.at(12, 28), 0);
}

TEST(Render, AreaConvergesToTheIntegralWithTheCosinesInside) {
  // Half of a wide rect light is hidden by a wall that stands on the floor beside the point; the
  // other half is a rect of its own.
  const auto scene_with = [](float width, bool wall) {
    Scene scene;
    add_floor(scene, add_material(scene, diffuse_material(Vec3(1.0f))));
    if (wall) add_quad(scene, {0, 0, -3}, {0, 3, 0}, {0, 0, 6}, 0);
    Light light;
    light.type = LightType::rect;
    light.position = {0.5f * width - (wall ? 1.0f : 0.0f), 2, 0};
    light.edge_u = {width, 0, 0};
    light.edge_v = {0, 0, 1};
    light.normal = {0, -1, 0};
    light.emission = Vec3(1.0f);
    scene.lights.push_back(light);
    scene.ambient = {};
    add_camera(scene, {1e-3f, 1, 0}, {1e-3f, 0, 0}, 1e-4f);
    return scene;
  };
  RenderOptions options = small_options(ShadowKind::area, 1, 1);
  options.shadows.light_samples = 4096;
  const float half_hidden = color_at(picture(scene_with(2, true), options), 0, 0).x;
  options.shadows.kind = ShadowKind::none;
  const float half = color_at(picture(scene_with(1, false), options), 0, 0).x;
  EXPECT_NEAR(half_hidden, half, 0.01f * half);
}

TEST(Render, AdaptiveAreaTakesOneRayToALightWithoutExtent) {
  Scene scene = still_life();
  Light sun;
  sun.type = LightType::sun;
  sun.direction = normalize(Vec3{-0.3f, -1, -0.2f});
  sun.emission = Vec3(1.0f);
  scene.lights = {sun};
  RenderOptions options = small_options(ShadowKind::area);
  options.want_error = true;
  const RenderResult fixed = picture(scene, options);
  options.shadows.error = 0.002f;
  const RenderResult adaptive = picture(scene, options);
  EXPECT_EQ(adaptive.color.data, fixed.color.data);
  EXPECT_GT(adaptive.stats.shadows.rays, 0u);
  EXPECT_LE(adaptive.stats.shadows.rays, adaptive.stats.primary_rays + adaptive.stats.mirror_rays);
  for (const float error : adaptive.error.data) ASSERT_EQ(error, 0);
}

TEST(Render, HardShadowsFadeOutWhereTheLightsCentreSets) {
  Scene scene;
  add_floor(scene, add_material(scene, diffuse_material(Vec3(1.0f))));
  add_sphere_light(scene, {3, 0.1f, 0}, 0.5f, 100);
  add_camera(scene, {0, 1, 1e-3f}, {0, 0, 0}, 1e-4f);
  scene.ambient = {};
  const float found = color_at(picture(scene, small_options(ShadowKind::hard, 1, 1)), 0, 0).x;
  const float d2 = 9 + 0.01f, expected = 100 * 0.25f / d2 * 0.1f / std::sqrt(d2);
  EXPECT_NEAR(found, expected, 0.01f * expected);
  EXPECT_GT(color_at(picture(scene, small_options(ShadowKind::area, 1, 1)), 0, 0).x, 1.5f * found);
}

TEST(Render, TheErrorAskedForIsThePixels) {
  const Scene scene = still_life();
  RenderOptions options = small_options(ShadowKind::area);
  options.shadows.error = 0.02f;
  const auto rays_per_sample = [&] {
    const RenderStats stats = picture(scene, options).stats;
    return static_cast<double>(stats.shadows.rays) / static_cast<double>(stats.primary_rays);
  };
  const double one = rays_per_sample();
  options.spp = 4;
  const double more = rays_per_sample();
  EXPECT_LT(more, 0.8 * one) << "four samples may err twice as much each";
  options.shadows.error = 0.01f;
  EXPECT_NEAR(rays_per_sample(), one, 0.1 * one);
}

TEST(Render, RefusesWhatCannotBe) {
  Scene scene = still_life();
  const auto refused = [&](auto change) {
    RenderOptions options = small_options(ShadowKind::none);
    change(options);
    EXPECT_THROW(picture(scene, options), InputError);
  };
  refused([](RenderOptions& o) { o.width = 0; });
  refused([](RenderOptions& o) { o.height = -1; });
  refused([](RenderOptions& o) { o.spp = 0; });
  refused([](RenderOptions& o) { o.camera = 1; });
}

}  // namespace
}  // namespace penumbra
