#include "bake/cut_charts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "bake/bake_scenes.h"
#include "bake/texel_map.h"
#include "bake/triangulate.h"

namespace penumbra::bake {
namespace {

using test::add_cube;
using test::add_mesh;
using test::add_quad;

std::vector<CutChart> cut(const Scene& scene, std::uint32_t instance, bool back = false,
                          float texel = 0.05f) {
  const WorldMesh mesh(scene, instance);
  const Adjacency adjacency(mesh);
  ChartRemarks remarks;
  ChartOptions options;
  options.texel_size = texel;
  return cut_charts(scene, mesh, adjacency, back, options, remarks);
}

void expect_every_triangle_once(const std::vector<CutChart>& charts, std::size_t count) {
  std::multiset<std::uint32_t> seen;
  for (const CutChart& chart : charts)
    seen.insert(chart.shape.triangles.begin(), chart.shape.triangles.end());
  ASSERT_EQ(seen.size(), count);
  EXPECT_EQ(std::set<std::uint32_t>(seen.begin(), seen.end()).size(), count);
}

TEST(CutCharts, AQuadIsOneExactChart) {
  Scene scene;
  const auto quad = add_quad(scene, {0, 0, 0}, {2, 0, 0}, {0, 0, -1});
  const auto charts = cut(scene, quad);
  ASSERT_EQ(charts.size(), 1u);
  const PlanarChart& chart = charts[0].shape;
  EXPECT_TRUE(charts[0].flat);
  EXPECT_EQ(std::minmax(chart.width, chart.height), std::minmax(40, 20));
  EXPECT_NEAR(chart.normal.y, 1, 1e-6f);
  const auto places = map_texels(chart, WorldMesh(scene, quad), 0);
  EXPECT_TRUE(std::ranges::all_of(places, [](const TexelPlace& p) { return p.is_inside(); }));
}

TEST(CutCharts, TheBackFacesTheOtherWay) {
  Scene scene;
  const auto quad = add_quad(scene, {0, 0, 0}, {2, 0, 0}, {0, 0, -1});
  const auto charts = cut(scene, quad, true);
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_TRUE(charts[0].shape.back);
  EXPECT_NEAR(charts[0].shape.normal.y, -1, 1e-6f);
  EXPECT_LT(cross(charts[0].shape.edge_x, charts[0].shape.edge_y).y, 0);
}

TEST(CutCharts, AMirroredInstanceKeepsItsFront) {
  Scene scene;
  const auto quad = add_quad(scene, {0, 0, 0}, {2, 0, 0}, {0, 0, -1});
  scene.instances[quad].world_from_mesh.x = {-1, 0, 0};
  const WorldMesh mesh(scene, quad);
  EXPECT_NEAR(mesh.normal(0).y, 1, 1e-6f);
  EXPECT_NEAR(cut(scene, quad)[0].shape.normal.y, 1, 1e-6f);
}

TEST(CutCharts, ACubeIsSix) {
  Scene scene;
  const auto cube = add_cube(scene);
  const auto charts = cut(scene, cube);
  EXPECT_EQ(charts.size(), 6u);
  expect_every_triangle_once(charts, 12);
}

TEST(CutCharts, ABentQuadIsNotTakenForFlat) {
  Scene scene;
  const auto bent =
      add_mesh(scene, {{0, 0, 0}, {2, 0, 0}, {2, 0.3f, -2}, {0, 0, -2}}, {0, 1, 2, 0, 2, 3});
  const auto charts = cut(scene, bent);
  EXPECT_EQ(charts.size(), 2u);
  for (const CutChart& chart : charts) EXPECT_TRUE(chart.half);
}

TEST(CutCharts, NonManifoldAndDuplicateTrianglesAreEachInOneChart) {
  Scene scene;
  // Three fins about one edge, one of them twice, once more turned round.
  const auto fins = add_mesh(scene, {{0, 0, 0}, {0, 2, 0}, {2, 1, 0}, {-2, 1, 1}, {-2, 1, -1}},
                             {0, 2, 1, 0, 1, 3, 0, 1, 4, 0, 2, 1, 0, 1, 2});
  expect_every_triangle_once(cut(scene, fins), 5);
}

TEST(CutCharts, CurvedChartsHoldEveryTriangleAndDoNotOverlap) {
  Scene in;
  in.objects.push_back({"ball", true});
  in.materials.emplace_back();
  in.spheres.push_back({{1, 2, 3}, 1.5f, 0, 0});
  const Scene scene = triangulated(in, {});
  const auto charts = cut(scene, 0);
  expect_every_triangle_once(charts, 5120);
  EXPECT_LE(charts.size(), 30u);
  const WorldMesh mesh(scene, 0);
  for (const CutChart& chart : charts) {
    EXPECT_FALSE(chart.flat);
    EXPECT_THAT(overlapping(chart.shape, mesh), ::testing::IsEmpty());
    for (const std::uint32_t t : chart.shape.triangles)
      EXPECT_GT(dot(mesh.normal(t), chart.shape.normal), 0.2f);
  }
}

// Whatever a chart without area is made of, its texels stand for nothing.
TEST(CutCharts, AChartWithoutAreaHasNoPlaces) {
  Scene scene;
  const auto triangle = add_mesh(scene, {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}}, {0, 1, 2});
  PlanarChart chart = cut(scene, triangle)[0].shape;
  chart.edge_x = chart.edge_y = Vec3(0, 0, 0);
  for (const TexelPlace& p : map_texels(chart, WorldMesh(scene, triangle), 1.5f))
    EXPECT_FALSE(p.is_used());
}

TEST(CutCharts, TexelsOutsideStandForPointsJustInside) {
  Scene scene;
  const auto triangle = add_mesh(scene, {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}}, {0, 1, 2});
  const auto charts = cut(scene, triangle);
  ASSERT_EQ(charts.size(), 1u);
  const WorldMesh mesh(scene, triangle);
  std::size_t outside = 0;
  for (const TexelPlace& p : map_texels(charts[0].shape, mesh, 1.5f)) {
    if (!p.is_used()) continue;
    EXPECT_GT(std::min({p.b1, p.b2, 1 - p.b1 - p.b2}), p.is_inside() ? -1e-6f : 0.0f);
    outside += !p.is_inside();
  }
  EXPECT_GT(outside, 10u);
}

TEST(CutCharts, FinerTexelsWhereTheTextureIsFiner) {
  Scene scene;
  const auto quad = add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 0, -1});
  scene.meshes[0].uv[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  scene.textures.push_back({"fine", 40, 40, std::vector<std::uint8_t>(4 * 40 * 40, 255)});
  scene.materials[0].diffuse_map.image = 0;
  EXPECT_EQ(cut(scene, quad, false, 0.05f)[0].shape.width, 40);
  EXPECT_EQ(cut(scene, quad, false, 0.01f)[0].shape.width, 100);
}

TEST(Receivers, ClosedBodiesHaveNoBackUnlessSomethingIsInside) {
  Scene scene;
  const auto cube = add_cube(scene), quad = add_quad(scene, {-9, -2, 9}, {18, 0, 0}, {0, 0, -18});
  for (Material& material : scene.materials) material.double_sided = true;
  const auto back = [&](std::uint32_t instance) {
    const WorldMesh mesh(scene, instance);
    return has_back(scene, mesh, Adjacency(mesh));
  };
  EXPECT_FALSE(back(cube));
  EXPECT_TRUE(back(quad));
  scene.lights.emplace_back().position = {0.1f, 0.2f, 0.3f};
  EXPECT_TRUE(back(cube));
  scene.materials[0].double_sided = false;
  EXPECT_FALSE(back(cube));
}

}  // namespace
}  // namespace penumbra::bake
