#include "bake/light_chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "bake/bake_scenes.h"

namespace penumbra::bake {
namespace {

using test::add_mesh;
using test::add_quad;
using test::FieldIrradiance;

constexpr float pi = std::numbers::pi_v<float>;

LightOptions of_irradiance() {
  LightOptions options;
  options.quantity = Quantity::irradiance;
  return options;
}

/// One instance's front, lit.
class LightChart : public ::testing::Test {
 protected:
  LitChart light(FieldIrradiance::Function f, const LightOptions& options, float texel = 0.1f) {
    mesh_ = std::make_unique<WorldMesh>(scene_, 0);
    ChartRemarks remarks;
    ChartOptions cut;
    cut.texel_size = texel;
    chart_ = cut_charts(scene_, *mesh_, Adjacency(*mesh_), false, cut, remarks).at(0);
    const MaterialLookup materials(scene_);
    return light_chart(chart_, *mesh_, FieldIrradiance(f), {scene_, materials, ambient_}, options);
  }

  Scene scene_;
  Vec3 ambient_;
  std::unique_ptr<WorldMesh> mesh_;
  CutChart chart_;
};

TEST_F(LightChart, HoldsEquationTwo) {
  add_quad(scene_, {0, 0, 0}, {1, 0, 0}, {0, 0, -1});
  scene_.materials[0].diffuse = {0.5f, 0.25f, 1};
  scene_.materials[0].emission = {0, 0, 2};
  ambient_ = Vec3(0.1f);
  const LitChart lit = light([](const Vec3&) { return Vec3(pi); }, {});
  for (const Vec3& v : lit.texels.value) {
    EXPECT_NEAR(v.x, 0.5f * 1.1f, 1e-5f);
    EXPECT_NEAR(v.y, 0.25f * 1.1f, 1e-5f);
    EXPECT_NEAR(v.z, 1.1f + 2, 1e-5f);
  }
}

TEST_F(LightChart, HoldsIrradianceAloneForLightmaps) {
  add_quad(scene_, {0, 0, 0}, {1, 0, 0}, {0, 0, -1});
  ambient_ = Vec3(0.1f);
  const LitChart lit = light([](const Vec3& p) { return Vec3(p.x); }, of_irradiance());
  for (std::size_t i = 0; i < lit.texels.value.size(); ++i) {
    const int width = chart_.shape.width;
    const Vec3 at = chart_.shape.texel(static_cast<float>(static_cast<int>(i) % width),
                                       static_cast<float>(static_cast<int>(i) / width));
    EXPECT_NEAR(lit.texels.value[i].x, at.x, 1e-5f);
  }
}

TEST_F(LightChart, TexelsOutsideTakeTheLightOfTheNearestPointInside) {
  // Bright where the triangle is, black beyond its hypotenuse.
  add_mesh(scene_, {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}}, {0, 1, 2});
  const LitChart lit = light([](const Vec3& p) { return Vec3(p.x - p.z < 1.00001f ? 1.0f : 0.0f); },
                             of_irradiance());
  int known = 0;
  for (std::size_t i = 0; i < lit.texels.value.size(); ++i) {
    if (!lit.texels.is_known[i]) continue;
    EXPECT_EQ(lit.texels.value[i].x, 1);
    ++known;
  }
  EXPECT_GT(known, 60);
  EXPECT_LT(known, 100);
}

TEST_F(LightChart, SupersamplingAveragesWithinTexels) {
  add_quad(scene_, {0, 0, 0}, {1, 0, 0}, {0, 0, -1});
  LightOptions options = of_irradiance();
  options.supersample = 4;
  // An edge a quarter into the texel from 0.4 to 0.5 m.
  const auto edge = [](const Vec3& p) { return Vec3(p.x < 0.425f ? 0.0f : 1.0f); };
  const LitChart lit = light(edge, options);
  int part = 0;
  for (const Vec3& v : lit.texels.value)
    if (v.x > 0 && v.x < 1) {
      EXPECT_NEAR(v.x, 0.75f, 1e-5f);
      ++part;
    }
  EXPECT_EQ(part, 10);
}

TEST_F(LightChart, SmoothChartsBecomeVertexColoursWithinTheBound) {
  add_quad(scene_, {0, 0, 0}, {1, 0, 0}, {0, 0, -1});
  scene_.materials[0].diffuse = Vec3(1.0f);
  LightOptions options;
  options.vertex_error = 1;
  EXPECT_FALSE(light([](const Vec3&) { return Vec3(1.0f); }, options).has_texels());
  // Half a step of 8 bits of waviness is within the bound, a shadow is not.
  EXPECT_FALSE(light([](const Vec3& p) { return Vec3(1 + 0.005f * std::sin(30 * p.x)); }, options)
                   .has_texels());
  EXPECT_TRUE(light([](const Vec3& p) { return Vec3(1 + 0.2f * std::sin(30 * p.x)); }, options)
                  .has_texels());
  EXPECT_TRUE(
      light([](const Vec3& p) { return Vec3(p.x < 0.5f ? 0.0f : 1.0f); }, options).has_texels());
}

TEST_F(LightChart, HolesAreKeptInTheTexels) {
  add_quad(scene_, {0, 0, 0}, {1, 0, 0}, {0, 0, -1});
  scene_.meshes[0].uv[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::vector<std::uint8_t> rgba(16, 255);
  rgba[3] = rgba[11] = 0;  // the left half
  scene_.textures.push_back({"leaf", 2, 2, rgba});
  scene_.materials[0].diffuse_map.image = 0;
  scene_.materials[0].diffuse_map.nearest = true;
  scene_.materials[0].alpha_cutoff = 0.5f;
  LightOptions options;
  options.vertex_error = 1;
  const LitChart lit = light([](const Vec3&) { return Vec3(1.0f); }, options);
  ASSERT_EQ(lit.texels.alpha.size(), lit.texels.value.size());
  EXPECT_EQ(std::ranges::count(lit.texels.alpha, 0.0f), std::ssize(lit.texels.alpha) / 2);
}

}  // namespace
}  // namespace penumbra::bake
