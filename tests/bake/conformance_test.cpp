// The rasteriser against shadow rays: the same samples, texel by texel.
#include <gtest/gtest.h>

#include <random>

#include "bake/charts.h"
#include "bake/raster_baker.h"
#include "bake/ray_baker.h"
#include "render/small_scenes.h"

namespace penumbra::bake {
namespace {

void add_triangle(Scene& scene, const Vec3& a, const Vec3& b, const Vec3& c) {
  Mesh mesh;
  mesh.positions = {a, b, c};
  mesh.indices = {0, 1, 2};
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  scene.meshes.push_back(mesh);
  scene.instances.push_back(instance);
}

ReceiverPatch patch_of(const PlanarChart& c) {
  return {
      {c.base, c.base + c.edge_x, c.base + c.edge_x + c.edge_y, c.base + c.edge_y}, c.normal, 1};
}

struct Disagreement {
  int edge = 0;      ///< texels that differ within 1/64 texel of an edge
  int beyond = 0;    ///< others
  int shadowed = 0;  ///< texels that anything hides some of the light from
};

/// Both ways on one chart and light. A texel may differ where moving it by 1/64 texel moves the
/// rays' answer as far.
Disagreement compare(const World& world, const PlanarChart& chart, const SampledLight& light,
                     bool fractions) {
  const Occluders occluders(world.scene());
  std::vector<float> found(static_cast<std::size_t>(chart.width) * chart.height);
  if (fractions) {
    RasterBaker(occluders).visible_fractions(chart, light, found);
  } else {
    std::vector<Vec3> rgb(found.size());
    SampledLight unit = light;
    unit.emission = {1, 0, 0};
    RasterBaker(occluders).irradiance(chart, std::span(&unit, 1), rgb);
    for (std::size_t i = 0; i < rgb.size(); ++i) found[i] = rgb[i].x;
  }
  const RayBaker rays(world);
  const auto by_rays = [&](float i, float j) {
    const PointLight p = rays.light({chart.texel(i, j), chart.normal}, light);
    return fractions ? p.fraction : p.irradiance;
  };
  Disagreement out;
  for (int j = 0; j < chart.height; ++j)
    for (int i = 0; i < chart.width; ++i) {
      const float x = static_cast<float>(i), y = static_cast<float>(j), e = 1.0f / 64;
      const float value = found[static_cast<std::size_t>(j) * chart.width + i];
      const float expected = by_rays(x, y), near = 5e-4f * std::max(expected, 0.02f);
      out.shadowed += expected < 0.999f;
      if (std::abs(value - expected) <= near) continue;
      float least = expected, most = expected;
      for (const auto [dx, dy] :
           {Vec2{e, 0}, {-e, 0}, {0, e}, {0, -e}, {e, e}, {-e, e}, {e, -e}, {-e, -e}}) {
        const float v = by_rays(x + dx, y + dy);
        least = std::min(least, v), most = std::max(most, v);
      }
      const bool explained = value >= least - near && value <= most + near;
      ++(explained ? out.edge : out.beyond);
      if (!explained)
        ADD_FAILURE() << i << ", " << j << ": " << value << ", by rays " << expected << " in ["
                      << least << ", " << most << "]";
      if (out.beyond > 5) return out;
    }
  return out;
}

Light light_of(LightType type) {
  Light light;
  light.type = type;
  light.position = {0.4f, 3, 0.2f};
  light.normal = normalize(Vec3{-0.2f, -1, 0.1f});
  const Frame f = frame_around(light.normal);
  light.edge_u = f.u * 0.8f, light.edge_v = f.v * -0.6f;
  if (type == LightType::segment) light.edge_u = {0.6f, 0.2f, 0.3f};
  light.radius = type == LightType::segment ? 0.01f : 0.3f;
  light.direction = normalize(Vec3{-0.5f, -0.8f, 0.2f});
  light.angular_diameter = 0.1f;
  light.emission = Vec3(1);
  return light;
}

class Conformance : public ::testing::TestWithParam<LightType> {};
INSTANTIATE_TEST_SUITE_P(Lights, Conformance,
                         ::testing::Values(LightType::point, LightType::sphere, LightType::disk,
                                           LightType::rect, LightType::segment, LightType::sun),
                         [](const auto& param) { return to_string(param.param); });

void run(const Scene& scene, const PlanarChart& chart, int samples, int least_shadowed) {
  const World world(scene, {.cone_tree = false});
  const LightViews views(scene);
  BakeOptions options;
  options.light_samples = samples;
  const LightSampler sampler(views, options);
  for (const bool fractions : {true, false}) {
    const SampledLight light = sampler.sample(0, patch_of(chart), fractions);
    const Disagreement d = compare(world, chart, light, fractions);
    EXPECT_EQ(d.beyond, 0);
    EXPECT_LT(d.edge, 1 + chart.width * chart.height / 20);
    EXPECT_GE(d.shadowed, least_shadowed);
  }
}

TEST_P(Conformance, OfTrianglesThatCrossAllPlanes) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-2, 2), height(-0.8f, 4), size(-0.8f, 0.8f);
    Scene scene;
    const auto grey = add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f}));
    add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0.4f, 0, -4}, grey);
    for (int i = 0; i < 60; ++i) {
      const Vec3 a{place(random), height(random), place(random)};
      add_triangle(scene, a, a + Vec3{size(random), size(random), size(random)},
                   a + Vec3{size(random), size(random), size(random)});
    }
    scene.lights.push_back(light_of(GetParam()));
    run(scene, chart_of_quad(scene, 0, 97, 70), 9, 300);
  }
}

TEST_P(Conformance, OfWallsThatStandOnTheReceiver) {
  Scene scene;
  const auto grey = add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f}));
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, grey);
  add_quad(scene, {-1, 0, -0.5f}, {1.5f, 0, 0.2f}, {0, 1, 0}, grey);
  add_quad(scene, {0.5f, -1, -2}, {0, 0, 4}, {0.5f, 5, 0}, grey);
  add_quad(scene, {-9, 0, 0.9f}, {18, 0, 0}, {0, 0.4f, 0}, grey);
  scene.lights.push_back(light_of(GetParam()));
  run(scene, chart_of_quad(scene, 0, 130, 65), 9, 300);
}

TEST_P(Conformance, OfSpheresBesideInAndUnderTheReceiver) {
  Scene scene;
  const auto grey = add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f}));
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, grey);
  add_sphere(scene, {0.2f, 0.8f, 0.1f}, 0.4f, grey);
  add_sphere(scene, {-1, 0.1f, 0.8f}, 0.5f, grey);
  add_sphere(scene, {-1, -0.2f, -0.8f}, 0.5f, grey);
  add_sphere(scene, {1.2f, -0.6f, -0.5f}, 0.5f, grey);
  add_sphere(scene, {1.4f, 3.1f, 0.4f}, 0.5f, grey);
  scene.lights.push_back(light_of(GetParam()));
  run(scene, chart_of_quad(scene, 0, 97, 70), 9, 300);
}

}  // namespace
}  // namespace penumbra::bake
