#include "bake/baked_irradiance.h"

#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "bake/charts.h"
#include "render/direct_light.h"
#include "render/small_scenes.h"
#include "scene/load.h"
#include "support/temporary_folder.h"

namespace penumbra::bake {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// A ball of 24 × 12 facets with the normals of a sphere.
Mesh smooth_ball(const Vec3& center, float radius) {
  Mesh mesh;
  constexpr int rings = 12, sectors = 24;
  for (int r = 0; r <= rings; ++r)
    for (int s = 0; s <= sectors; ++s) {
      const float t = pi * static_cast<float>(r) / rings;
      const float p = 2 * pi * static_cast<float>(s) / sectors;
      mesh.normals.push_back({std::sin(t) * std::cos(p), std::cos(t), std::sin(t) * std::sin(p)});
      mesh.positions.push_back(center + mesh.normals.back() * radius);
    }
  const auto at = [](int r, int s) { return static_cast<std::uint32_t>(r * (sectors + 1) + s); };
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < sectors; ++s) {
      if (r > 0)
        for (const auto i : {at(r, s), at(r, s + 1), at(r + 1, s)}) mesh.indices.push_back(i);
      if (r + 1 < rings)
        for (const auto i : {at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)})
          mesh.indices.push_back(i);
    }
  return mesh;
}

TEST(BakedIrradiance, OfSmoothSurfacesHasNoStripesAtTheTerminator) {
  Scene scene;
  add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f}));
  scene.meshes.push_back(smooth_ball({}, 1));
  scene.instances.emplace_back();
  add_sphere_light(scene, {0, 40, 0}, 2, 100);
  const World world(scene, {.cone_tree = false});
  const BakedIrradiance baked(world, {});
  const Mesh& mesh = scene.meshes[0];
  std::vector<SurfacePoint> points;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto corner = [&](int k) { return mesh.indices[3 * t + k]; };
    const Vec3 a = mesh.positions[corner(0)], b = mesh.positions[corner(1)],
               c = mesh.positions[corner(2)];
    for (const Vec3& w : {Vec3{0.4f, 0.3f, 0.3f}, Vec3{0.8f, 0.1f, 0.1f}, Vec3{0.1f, 0.1f, 0.8f}}) {
      SurfacePoint p;
      p.position = a * w.x + b * w.y + c * w.z;
      p.normal = normalize(cross(b - a, c - a));
      if (dot(p.normal, p.position) < 0) p.normal = -p.normal;
      p.shading_normal = normalize(mesh.normals[corner(0)] * w.x + mesh.normals[corner(1)] * w.y +
                                   mesh.normals[corner(2)] * w.z);
      p.instance = 0, p.triangle = t;
      points.push_back(p);
    }
  }
  std::vector<Vec3> found(points.size());
  baked.of_points(points, found);
  const LightViews views(scene);
  const DirectLight direct(views);
  int lit = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& n = points[i].shading_normal;
    const float expected = 100 * direct.irradiance(0, points[i].position, n, Horizon::exact);
    lit += expected > 0.1f;
    // A ball is lit on all of its upper half.
    ASSERT_NEAR(found[i].x, expected, 0.03f * expected + 0.01f) << i << " at " << n.y;
  }
  EXPECT_GT(lit, 200);
}

TEST(BakedIrradiance, OfDistanceFieldsIsTheirTriangles) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "s.json") << R"({
    "materials": {"a": {}},
    "objects": [
      {"type": "quad", "corner": [-2, 0, 2], "edge_u": [4, 0, 0], "edge_v": [0, 0, -4],
       "material": "a"},
      {"type": "sdf", "material": "a",
       "root": {"shape": "torus", "center": [0, 0.8, 0], "major_radius": 0.6,
                "minor_radius": 0.2}}],
    "lights": [{"type": "sphere", "position": [0.5, 4, 0.2], "radius": 0.3,
                "radiance": [10, 10, 10]}]})";
  const Scene scene = load_scene(folder / "s.json");
  const World world(scene, {.cone_tree = false});
  const PlanarChart chart = chart_of_quad(scene, 0, 64, 64);
  std::vector<float> by_cpu(64 * 64), by_rays(64 * 64);
  BakeOptions options;
  options.light_samples = 64;
  options.device = BakeDevice::cpu;
  BakedIrradiance(world, options).visible_fractions(chart, 0, by_cpu);
  options.device = BakeDevice::rays;
  BakedIrradiance(world, options).visible_fractions(chart, 0, by_rays);
  EXPECT_EQ(by_rays[32 * 64 + 18], 0);
  EXPECT_GT(by_rays[32 * 64 + 31], 0.5f);
  for (std::size_t i = 0; i < by_cpu.size(); ++i) ASSERT_NEAR(by_cpu[i], by_rays[i], 0.1f);
}

TEST(BakedIrradiance, AutomaticTakesOneOfTheTwoForEachChart) {
  const Scene scene = still_life();
  const World world(scene, {.cone_tree = false});
  const auto baked_by = [&](BakeDevice device, const PlanarChart& chart) {
    BakeOptions options;
    options.device = device;
    std::vector<Vec3> out(static_cast<std::size_t>(chart.width) * chart.height);
    BakedIrradiance(world, options).of_chart(chart, out);
    return out;
  };
  for (const int size : {1, 2, 200}) {
    const PlanarChart chart = chart_of_quad(scene, 0, size, size);
    const auto chosen = baked_by(BakeDevice::automatic, chart);
    EXPECT_TRUE(chosen == baked_by(BakeDevice::cpu, chart) ||
                chosen == baked_by(BakeDevice::rays, chart));
  }
}

TEST(BakedIrradiance, AddsUpLights) {
  Scene scene = still_life();
  const PlanarChart chart = chart_of_quad(scene, 0, 60, 40);
  std::vector<Vec3> sum(60 * 40), out(60 * 40), all(60 * 40);
  Light second = scene.lights[0];
  second.type = LightType::disk;
  second.normal = {0, -1, 0};
  second.position.x = -1;
  scene.lights.push_back(second);
  const auto bake = [&](const Scene& lit, std::vector<Vec3>& to) {
    const World world(lit, {.cone_tree = false});
    BakedIrradiance(world, {}).of_chart(chart, to);
  };
  bake(scene, all);
  for (const std::size_t which : {0, 1}) {
    // The other is dark: the samples of a light depend on its number.
    Scene lit = scene;
    lit.lights[1 - which].emission = {};
    bake(lit, out);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += out[i];
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    ASSERT_NEAR(sum[i].x, all[i].x, 1e-5f * (1 + all[i].x));
}

}  // namespace
}  // namespace penumbra::bake
