// The rasteriser against shadow rays: the same samples, texel by texel.
#include <gtest/gtest.h>

#include "bake/conformance_scenes.h"
#include "bake/raster_baker.h"
#include "bake/ray_baker.h"

namespace penumbra::bake {
namespace {

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
    Scene scene = triangles_across_all_planes(seed);
    scene.lights.push_back(light_of(GetParam()));
    run(scene, chart_of_quad(scene, 0, 97, 70), 9, 300);
  }
}

TEST_P(ConformanceUnder, OnALayoutThatIsMirrored) {
  Scene scene = triangles_across_all_planes(5);
  scene.lights.push_back(light_of(GetParam()));
  PlanarChart chart = chart_of_quad(scene, 0, 97, 70);
  chart.base += chart.edge_y;
  chart.edge_y = -chart.edge_y;
  run(scene, chart, 9, 300);
}

TEST_P(ConformanceUnder, OfWallsThatStandOnTheReceiver) {
  Scene scene = walls_on_the_receiver();
  scene.lights.push_back(light_of(GetParam()));
  run(scene, chart_of_quad(scene, 0, 130, 65), 9, 300);
}

TEST_P(ConformanceUnder, OfSpheresBesideInAndUnderTheReceiver) {
  Scene scene = spheres_all_round();
  scene.lights.push_back(light_of(GetParam()));
  run(scene, chart_of_quad(scene, 0, 97, 70), 9, 300);
}

TEST(Conformance, UnderMeshLights) {
  for (const bool box : {false, true})
    for (const bool double_sided : {false, true}) {
      const Scene scene = lit_by_mesh(box, double_sided);
      run(scene, chart_of_quad(scene, 0, 97, 70), 16, 300);
    }
}

TEST(Conformance, OfLeavesWithHoles) {
  Scene scene = leaves_with_holes();
  scene.lights.push_back(light_of(LightType::point));
  run(scene, chart_of_quad(scene, 0, 97, 70), 1, 300);
}

TEST(Conformance, OfClosedSurfacesThatReachThroughTheReceiverAndHoldTheLight) {
  for (const bool shade : {false, true}) {
    const Scene scene = closed_surfaces(shade);
    run(scene, chart_of_quad(scene, 0, 97, 70), 9, 300);
  }
}

}  // namespace
}  // namespace penumbra::bake
