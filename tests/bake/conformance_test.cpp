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

class ConformanceUnder : public ::testing::TestWithParam<LightType> {};
INSTANTIATE_TEST_SUITE_P(Lights, ConformanceUnder,
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

TEST_P(ConformanceUnder, OfTrianglesThatCrossAllPlanes) {
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

TEST_P(ConformanceUnder, OfWallsThatStandOnTheReceiver) {
  Scene scene;
  const auto grey = add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f}));
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, grey);
  add_quad(scene, {-1, 0, -0.5f}, {1.5f, 0, 0.2f}, {0, 1, 0}, grey);
  add_quad(scene, {0.5f, -1, -2}, {0, 0, 4}, {0.5f, 5, 0}, grey);
  add_quad(scene, {-9, 0, 0.9f}, {18, 0, 0}, {0, 0.4f, 0}, grey);
  scene.lights.push_back(light_of(GetParam()));
  run(scene, chart_of_quad(scene, 0, 130, 65), 9, 300);
}

TEST_P(ConformanceUnder, OfSpheresBesideInAndUnderTheReceiver) {
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

/// Front, or a whole box, as a light of its own.
Scene lit_by_mesh(bool box, bool double_sided) {
  Scene scene;
  const auto grey = add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f}));
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, grey);
  add_triangle(scene, {-1, 1, -0.5f}, {0.8f, 1.2f, 0.1f}, {0.1f, 0.4f, 1});
  // A ceiling in the plane of the light's lower face, and one through its middle.
  add_quad(scene, {-2, 2, -2}, {1.8f, 0, 0}, {0, 0, 4}, grey);
  add_quad(scene, {0.6f, 2.1f, -2}, {1, 0, 0}, {0, 0, 4}, grey);
  Mesh mesh;
  mesh.positions = {{-0.2f, 2, -0.2f},  {0.4f, 2, -0.2f},     {0.4f, 2, 0.3f},
                    {-0.2f, 2, 0.3f},   {-0.2f, 2.3f, -0.2f}, {0.4f, 2.3f, -0.2f},
                    {0.4f, 2.3f, 0.3f}, {-0.2f, 2.3f, 0.3f}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  if (box)
    mesh.indices = {0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6, 0, 5, 1, 0, 4, 5,
                    2, 7, 3, 2, 6, 7, 0, 3, 7, 0, 7, 4, 1, 6, 2, 1, 5, 6};
  Light light;
  light.type = LightType::mesh;
  light.instance = static_cast<int>(scene.instances.size());
  light.emission = Vec3(1);
  light.double_sided = double_sided;
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  instance.mesh_light = 0;
  scene.meshes.push_back(mesh);
  scene.instances.push_back(instance);
  scene.lights.push_back(light);
  return scene;
}

TEST(Conformance, UnderMeshLights) {
  for (const bool box : {false, true})
    for (const bool double_sided : {false, true}) {
      const Scene scene = lit_by_mesh(box, double_sided);
      run(scene, chart_of_quad(scene, 0, 97, 70), 16, 300);
    }
}

TEST(Conformance, OfLeavesWithHoles) {
  Scene scene;
  const auto grey = add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f}));
  TextureImage image;
  image.width = image.height = 16;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      for (const int value : {255, 255, 255, (x / 3 + y / 5) % 2 * 255})
        image.rgba.push_back(static_cast<std::uint8_t>(value));
  scene.textures.push_back(image);
  Material leaf = diffuse_material({0.1f, 0.7f, 0.1f});
  leaf.alpha_cutoff = 0.5f;
  leaf.diffuse_map.image = 0;
  const auto green = add_material(scene, leaf);
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, grey);
  add_quad(scene, {-1, 0.8f, 0.7f}, {1.9f, 0.3f, 0}, {0, 0.2f, -1.6f}, green);
  add_quad(scene, {-1.5f, -0.4f, 0.9f}, {0, 0, -1.6f}, {0.2f, 1.1f, 0}, green);
  scene.lights.push_back(light_of(LightType::point));
  run(scene, chart_of_quad(scene, 0, 97, 70), 1, 300);
}

TEST(Conformance, OfClosedSurfacesThatReachThroughTheReceiverAndHoldTheLight) {
  Scene scene;
  const auto grey = add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f}));
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, grey);
  const auto add_box = [&](const Vec3& lo, const Vec3& hi, bool inside_out) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
      mesh.positions.push_back({i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z});
    mesh.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    if (inside_out)
      for (std::size_t t = 0; t < mesh.indices.size(); t += 3)
        std::swap(mesh.indices[t], mesh.indices[t + 1]);
    Instance instance;
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back(mesh);
    scene.instances.push_back(instance);
  };
  add_box({-1, -0.3f, -1}, {-0.5f, 0.5f, -0.3f}, false);
  add_box({0.2f, -0.3f, -0.9f}, {0.7f, 0.6f, -0.2f}, true);
  add_box({-0.9f, 0.3f, 0.3f}, {-0.1f, 0.6f, 0.9f}, true);
  add_box({0.6f, 0, 0.4f}, {1.1f, 0.5f, 1}, false);
  for (const bool shade : {false, true}) {
    // Without a floor, and open: the light shines out of it from below.
    if (shade) {
      add_box({0, 2.6f, -0.2f}, {0.8f, 3.4f, 0.6f}, false);
      scene.meshes.back().indices.resize(30);
    }
    Scene lit = scene;
    lit.lights.push_back(light_of(LightType::sphere));
    run(lit, chart_of_quad(lit, 0, 97, 70), 9, 300);
  }
}

}  // namespace
}  // namespace penumbra::bake
