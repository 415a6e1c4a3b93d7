#include "bake/uv_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bake/bake.h"
#include "bake/bake_scenes.h"
#include "bake/uv_overlap.h"
#include "base/error.h"

namespace penumbra::bake {
namespace {

using test::add_cube;
using test::add_mesh;
using test::add_quad;
using test::FieldIrradiance;
using ::testing::HasSubstr;

Vec3 wavy(const Vec3& p) { return Vec3(2 + std::sin(9 * p.x) + std::sin(7 * p.z + 5 * p.y)); }

const std::vector<Vec2> whole{{0, 1}, {1, 1}, {1, 0}, {0, 0}};

class UvLayoutTest : public ::testing::Test {
 protected:
  UvLayoutTest() {
    textures_.texel_size = 0.05f;
    textures_.existing_uv = true;
  }

  /// A quad of 4 m × 2 m with these coordinates.
  Mesh& add_floor(const std::vector<Vec2>& uv, int set = 0) {
    add_quad(scene_, {0, 0, 0}, {4, 0, 0}, {0, 0, -2});
    scene_.meshes.back().uv[set] = uv;
    return scene_.meshes.back();
  }

  std::string error() {
    try {
      make_plan(scene_, textures_);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  }

  Baked bake_all(std::vector<Image>& pages, Output output = Output::radiance) {
    const LightViews views(scene_);
    const DirectLight lights(views);
    const MaterialLookup materials(scene_);
    const FieldIrradiance irradiance(wavy);
    const Plan plan = make_plan(scene_, textures_);
    Progress silent;
    return bake(
        {scene_, irradiance, lights, materials, Vec3(), 0}, plan, textures_, output,
        [&](int, std::size_t, const Image& image) { pages.push_back(image); }, silent);
  }

  Scene scene_;
  TextureOptions textures_;
};

TEST_F(UvLayoutTest, AFloorIsOneFlatChartAsLongAsItIsWide) {
  add_floor(whole);
  const Plan plan = make_plan(scene_, textures_);
  ASSERT_EQ(plan.charts.size(), 1u);
  ASSERT_EQ(plan.placed->pages.size(), 1u);
  EXPECT_EQ(plan.placed->pages[0].width, 80);
  EXPECT_EQ(plan.placed->pages[0].height, 40);
  const CutChart& chart = plan.charts[0];
  EXPECT_TRUE(chart.flat);
  // Row 0 is at v = 0, the floor's far side.
  EXPECT_NEAR(length(chart.shape.texel(0, 0) - Vec3(0.025f, 0, -1.975f)), 0, 1e-5f);
  EXPECT_NEAR(length(chart.shape.texel(79, 39) - Vec3(3.975f, 0, -0.025f)), 0, 1e-5f);
  EXPECT_NEAR(chart.shape.normal.y, 1, 1e-6f);
}

TEST_F(UvLayoutTest, TheSecondSetGoesFirst) {
  Mesh& mesh = add_floor(whole);
  mesh.uv[1] = {{0.5f, 0.5f}, {0.75f, 0.5f}, {0.75f, 0.25f}, {0.5f, 0.25f}};
  const Plan plan = make_plan(scene_, textures_);
  ASSERT_EQ(plan.charts.size(), 1u);
  EXPECT_EQ(plan.charts[0].shape.uv->set, 1);
  // A sixteenth of a page.
  EXPECT_EQ(plan.placed->pages[0].width, 320);
  EXPECT_EQ(plan.placed->pages[0].height, 160);
  EXPECT_EQ(plan.placed->places[0].x, 158);
  EXPECT_EQ(plan.placed->places[0].y, 38);
}

TEST_F(UvLayoutTest, TexelsHoldWhatTheCoordinatesSayAndCoordinatesStay) {
  // Two sides of a roof whose layouts are turned, and mirrored, and touch.
  add_mesh(scene_,
           {{0, 0, 0},
            {4, 0, 0},
            {4, 1, -2},
            {0, 1, -2},
            {0, 1, -2},
            {4, 1, -2},
            {4, 0, -4},
            {0, 0, -4}},
           {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7});
  const std::vector<Vec2> uv{{0.1f, 0.1f}, {0.1f, 0.9f}, {0.5f, 0.9f}, {0.5f, 0.1f},
                             {0.5f, 0.9f}, {0.5f, 0.1f}, {0.9f, 0.1f}, {0.9f, 0.9f}};
  scene_.meshes[0].uv[0] = uv;
  std::vector<Image> pages;
  const Baked baked = bake_all(pages, Output::lightmap);
  ASSERT_EQ(pages.size(), 1u);
  ASSERT_EQ(baked.model.nodes.size(), 1u);
  const GlbPrimitive& out = baked.model.nodes[0].primitives.at(0);
  ASSERT_EQ(out.positions.size(), 8u);
  std::size_t tested = 0;
  for (std::size_t i = 0; i < out.indices.size(); i += 3) {
    const auto mean = [&](const auto& v) {
      const auto &a = v[out.indices[i]], &b = v[out.indices[i + 1]], &c = v[out.indices[i + 2]];
      if constexpr (requires { a.z; })
        return (a + b + c) / 3.0f;
      else
        return Vec2{(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3};
    };
    const Vec2 at = mean(out.uv[1]);
    const Image& page = pages[0];
    const float* texel = page.at(static_cast<int>(at.x * static_cast<float>(page.width)),
                                 static_cast<int>(at.y * static_cast<float>(page.height)));
    // Half a texel of 5 cm off at most, and the field's slope is below 13 / m.
    EXPECT_NEAR(texel[0], wavy(mean(out.positions)).x, 0.5f);
    ++tested;
  }
  EXPECT_EQ(tested, 4u);
  for (std::size_t v = 0; v < 8; ++v)
    EXPECT_TRUE(std::ranges::any_of(
        uv, [&](const Vec2& x) { return x.x == out.uv[1][v].x && x.y == out.uv[1][v].y; }));
}

TEST_F(UvLayoutTest, BothSidesHavePagesOfTheirOwn) {
  add_floor(whole);
  scene_.materials[0].double_sided = true;
  const Plan plan = make_plan(scene_, textures_);
  ASSERT_EQ(plan.placed->pages.size(), 2u);
  EXPECT_EQ(plan.placed->places[1].page, 1);
  EXPECT_NEAR(plan.charts[1].shape.normal.y, -1, 1e-6f);
}

TEST_F(UvLayoutTest, WhatIsNotAffineIsOneCurvedChart) {
  // A quad whose layout is a trapezium: its halves are stretched differently, but each is affine;
  // smooth normals make it curved.
  Mesh& mesh = add_floor(whole);
  const Vec3 tilted = normalize(Vec3{0.3f, 1, 0});
  mesh.normals = {tilted, {0, 1, 0}, tilted, {0, 1, 0}};
  const Plan plan = make_plan(scene_, textures_);
  ASSERT_EQ(plan.charts.size(), 1u);
  EXPECT_FALSE(plan.charts[0].flat);
  const auto places = map_texels(plan.charts[0].shape, *plan.meshes[0], 0);
  EXPECT_TRUE(std::ranges::all_of(places, [](const TexelPlace& p) { return p.is_inside(); }));
  const MeshPoint first{places[0].triangle, places[0].b1, places[0].b2, false};
  EXPECT_NEAR(length(surface_point(*plan.meshes[0], first).position - Vec3(0.025f, 0, -1.975f)), 0,
              1e-4f);
}

TEST_F(UvLayoutTest, AnObjectsMeshesShareAPageUnlessTheyOverlap) {
  add_floor({{0, 0.5f}, {1, 0.5f}, {1, 0}, {0, 0}});
  add_floor({{0, 1}, {1, 1}, {1, 0.5f}, {0, 0.5f}});
  scene_.instances[1].object = 0;
  EXPECT_EQ(make_plan(scene_, textures_).placed->pages.size(), 1u);
  scene_.meshes[1].uv[0] = whole;
  EXPECT_EQ(make_plan(scene_, textures_).placed->pages.size(), 2u);
}

TEST_F(UvLayoutTest, PagesArePowersOfTwoWhenAskedFor) {
  add_floor(whole);
  textures_.power_of_two = true;
  const AtlasPage page = make_plan(scene_, textures_).placed->pages[0];
  EXPECT_EQ(page.width, 128);
  EXPECT_EQ(page.height, 64);
}

constexpr const char* remedy =
    "; lay it out without overlap in [0, 1] as TEXCOORD_1, choose others by --receivers, or leave "
    "--uv out";

TEST_F(UvLayoutTest, MissingCoordinatesAreRefused) {
  add_quad(scene_, {0, 0, 0}, {4, 0, 0}, {0, 0, -2});
  EXPECT_EQ(error(), std::string("--uv existing: 'object 0' has no texture coordinates") + remedy);
}

TEST_F(UvLayoutTest, CoordinatesBeyondTheTextureAreRefused) {
  add_floor({{0, 1}, {3, 1}, {3, 0}, {0, 0}});
  EXPECT_EQ(error(), std::string("--uv existing: 'object 0' reaches beyond [0, 1] in TEXCOORD_0: "
                                 "from (0, 0) to (3, 1)") +
                         remedy);
  scene_.meshes[0].uv[0][1].x = NAN;
  EXPECT_THAT(error(), HasSubstr("no numbers"));
}

TEST_F(UvLayoutTest, LayoutsBesideTheUnitSquareAreMovedOntoIt) {
  add_floor({{-2, 2}, {-1, 2}, {-1, 1}, {-2, 1}});
  const Plan plan = make_plan(scene_, textures_);
  ASSERT_EQ(plan.charts.size(), 1u);
  EXPECT_NEAR(length(plan.charts[0].shape.texel(0, 0) - Vec3(0.025f, 0, -1.975f)), 0, 1e-5f);
  std::vector<Image> pages;
  const Baked baked = bake_all(pages);
  for (const Vec2& uv : baked.model.nodes.at(0).primitives.at(0).uv.at(0))
    EXPECT_TRUE((uv.x == 0 || uv.x == 1) && (uv.y == 0 || uv.y == 1));
}

TEST_F(UvLayoutTest, AFewTrianglesWithoutAreaAreRemarkedUpon) {
  add_mesh(scene_, {{0, 0, 0}, {4, 0, 0}, {4, 0, -2}, {0, 0, -2}, {4.02f, 0, -1}},
           {0, 1, 2, 0, 2, 3, 1, 4, 2});
  scene_.meshes[0].uv[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}, {1, 0.5f}};
  const Plan plan = make_plan(scene_, textures_);
  EXPECT_THAT(plan.remarks.squeezed, ::testing::ElementsAre("object 0"));
}

TEST_F(UvLayoutTest, CoordinatesWithoutAreaAreRefused) {
  add_floor({{0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}}, 1);
  EXPECT_EQ(error(), std::string("--uv existing: 'object 0' has no area in TEXCOORD_1") + remedy);
  scene_.meshes[0].uv[1] = {{0, 1}, {1, 1}, {1, 0}, {0.5f, 0.5f}};
  EXPECT_EQ(error(), std::string("--uv existing: 'object 0' has 1 of 2 triangles without area in "
                                 "TEXCOORD_1") +
                         remedy);
}

TEST_F(UvLayoutTest, OverlapIsRefused) {
  add_cube(scene_);
  std::vector<Vec2>& uv = scene_.meshes[0].uv[0];
  for (int face = 0; face < 6; ++face) uv.insert(uv.end(), whole.begin(), whole.end());
  const std::string told = error();
  EXPECT_THAT(told, HasSubstr("--uv existing: 'object 0' overlaps itself in TEXCOORD_0 on "));
  EXPECT_THAT(told, HasSubstr(" % of its texels: triangles 0 and 2, near (0, 1)"));
  EXPECT_THAT(told, HasSubstr(remedy));
  // Side by side, with edges in common, it is none.
  for (std::size_t v = 0; v < uv.size(); ++v)
    uv[v] = {(uv[v].x + static_cast<float>(v / 4)) / 6, uv[v].y};
  EXPECT_EQ(error(), "no error");
  EXPECT_TRUE(make_plan(scene_, textures_).remarks.squeezed.empty());
}

TEST_F(UvLayoutTest, AFewContestedTexelsAreRemarkedUpon) {
  // A small flap folded onto the floor's corner.
  add_mesh(scene_,
           {{0, 0, 0}, {4, 0, 0}, {4, 0, -2}, {0, 0, -2}, {4, 0, 0}, {4.1f, 0, 0}, {4, 0, -0.1f}},
           {0, 1, 2, 0, 2, 3, 4, 5, 6});
  scene_.meshes[0].uv[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}, {1, 1}, {0.97f, 1}, {1, 0.93f}};
  const Plan plan = make_plan(scene_, textures_);
  EXPECT_THAT(plan.remarks.squeezed, ::testing::ElementsAre("object 0"));
}

TEST(ClaimedTexels, ThatTrianglesShareAreCounted) {
  std::vector<LaidTriangle> triangles;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      const float a = 1.3f * static_cast<float>(x), b = 1.3f * static_cast<float>(y);
      triangles.push_back({{{a, b}, {a + 1.3f, b}, {a, b + 1.3f}}});
      triangles.push_back({{{a + 1.3f, b + 1.3f}, {a + 1.3f, b}, {a, b + 1.3f}}});
    }
  ClaimedTexels page(52, 52);
  page.add(triangles);
  EXPECT_GT(page.overlap().covered, 2000u);
  EXPECT_EQ(page.overlap().contested, 0u);
  // Two triangles of 4 × 3 texels from (20, 30) on.
  const std::vector<LaidTriangle> over{{{{20, 30}, {24, 30}, {20, 33}}},
                                       {{{24, 33}, {20, 33}, {24, 30}}}};
  page.add(over);
  EXPECT_GE(page.overlap().contested, 5u);
  EXPECT_LE(page.overlap().contested, 12u);
  EXPECT_GE(page.overlap().b, triangles.size());
}

}  // namespace
}  // namespace penumbra::bake
