// Curved charts shadowed on a plane (Heckbert and Herf 1997, figure 5) against rays.
#include <gtest/gtest.h>

#include <cmath>

#include "bake/bake_scenes.h"
#include "bake/baked_irradiance.h"
#include "bake/light_chart.h"

namespace penumbra::bake {
namespace {

/// A strip of 2 m × 2 m whose middle is `rise` above its sides, under half a roof and a square
/// light to one side.
Scene vault(float rise) {
  Scene scene;
  Mesh mesh;
  constexpr int steps = 32;
  for (int i = 0; i <= steps; ++i) {
    const float x = 2.0f * static_cast<float>(i) / steps - 1;
    const Vec3 normal = normalize(Vec3{2 * rise * x, 1, 0});
    for (const float z : {1.0f, -1.0f}) {
      mesh.positions.push_back({x, rise * (1 - x * x), z});
      // Never quite flat: charts of flat ones are another matter.
      mesh.normals.push_back(normalize(normal + Vec3{0, 0, 0.004f * z}));
    }
  }
  for (std::uint32_t i = 0; i < steps; ++i)
    for (const std::uint32_t v : {2 * i, 2 * i + 2, 2 * i + 3, 2 * i, 2 * i + 3, 2 * i + 1})
      mesh.indices.push_back(v);
  test::add_mesh(scene, mesh.positions, mesh.indices);
  scene.meshes[0].normals = mesh.normals;
  test::add_quad(scene, {-0.2f, 0.8f, -0.5f}, {0, 0, 1}, {0.9f, 0, 0});
  Light light;
  light.type = LightType::rect;
  light.position = {1.2f, 2.5f, 0};
  light.normal = {0, -1, 0};
  light.edge_u = {0.3f, 0, 0}, light.edge_v = {0, 0, 0.3f};
  light.emission = {10, 20, 30};
  scene.lights.push_back(light);
  return scene;
}

struct Difference {
  float rms = 0, brightest = 0;
  float least = INFINITY, most = -INFINITY;  ///< by plane − by rays
};

/// Plane against rays, of the irradiance of all charts of the vault.
Difference difference(const Scene& scene, float texel = 0.04f) {
  const World world(scene, {.cone_tree = false});
  const WorldMesh mesh(scene, 0);
  const Adjacency adjacency(mesh);
  ChartRemarks remarks;
  ChartOptions chart_options;
  chart_options.texel_size = texel;
  BakeOptions options;
  options.light_samples = 64;
  const BakedIrradiance rays(world, options);
  options.curved = CurvedShadows::plane;
  const BakedIrradiance plane(world, options);
  double sum = 0, count = 0;
  Difference out;
  for (const CutChart& chart : cut_charts(scene, mesh, adjacency, false, chart_options, remarks)) {
    EXPECT_FALSE(chart.flat);
    ChartSamples a = samples_of(chart, mesh, 1), b = a;
    find_irradiance(chart, mesh, rays, a);
    find_irradiance(chart, mesh, plane, b);
    for (std::size_t i = 0; i < a.values.size(); ++i) {
      if (!a.places[i].is_used()) continue;
      const float d = b.values[i].y - a.values[i].y;
      sum += double{d} * d, count += 1;
      out.least = std::min(out.least, d), out.most = std::max(out.most, d);
      out.brightest = std::max(out.brightest, a.values[i].y);
      EXPECT_NEAR(b.values[i].x * 2, b.values[i].y, 1e-4f * (1 + b.values[i].y));
    }
  }
  out.rms = static_cast<float>(std::sqrt(sum / count));
  return out;
}

TEST(CurvedPlane, IsRaysInTheLimitOfAFlatSurface) {
  const Difference d = difference(vault(1e-4f));
  EXPECT_GT(d.brightest, 0.2f);
  EXPECT_LT(d.rms, 0.01f * d.brightest);
}

TEST(CurvedPlane, ErrsTheMoreTheMoreTheSurfaceIsCurved) {
  float last = difference(vault(0.02f)).rms;
  for (const float rise : {0.05f, 0.1f, 0.2f}) {
    const float next = difference(vault(rise)).rms;
    EXPECT_GT(next, 1.2f * last) << rise;
    last = next;
  }
}

TEST(CurvedPlane, LeavesOutTheSurfacesOwnShadows) {
  // A trough without a roof, whose near side hides the light from its bottom.
  Scene scene = vault(-0.8f);
  scene.instances.pop_back();
  scene.lights[0].position = {2.4f, 0.8f, 0};
  scene.lights[0].normal = normalize(Vec3{-1, -0.5f, 0});
  scene.lights[0].edge_u = {0, 0, 0.3f}, scene.lights[0].edge_v = {-0.1f, 0.2f, 0};
  const Difference d = difference(scene);
  EXPECT_GT(d.most, 0.2f * d.brightest);
  EXPECT_GT(d.least, -1e-3f * d.brightest);
}

TEST(CurvedPlane, TakesRaysWhereTheLightReachesBelowThePlane) {
  Scene scene = vault(0.2f);
  scene.lights[0].position = {2, 0.1f, 0};
  scene.lights[0].normal = {-1, 0, 0};
  scene.lights[0].edge_u = {0, 0, 0.5f}, scene.lights[0].edge_v = {0, 0.8f, 0};
  EXPECT_EQ(difference(scene).rms, 0);
}

}  // namespace
}  // namespace penumbra::bake
