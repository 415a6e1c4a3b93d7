// OpenGL against the rasteriser: the same samples, texel by texel.
#include <gtest/gtest.h>

#include "bake/clip.h"
#include "bake/conformance_scenes.h"
#include "bake/driver.h"
#include "bake/gl/gl_baker.h"
#include "bake/raster_baker.h"

namespace penumbra::bake {
namespace {

constexpr LightType all_types[] = {LightType::point, LightType::sphere,  LightType::disk,
                                   LightType::rect,  LightType::segment, LightType::sun};

/// Fractions, or irradiance per unit emission.
template <class Baker>
std::vector<float> baked(const Baker& baker, const PlanarChart& chart, const SampledLight& light,
                         bool fractions) {
  std::vector<float> values(static_cast<std::size_t>(chart.width) * chart.height);
  if (fractions) {
    baker.visible_fractions(chart, light, values);
    return values;
  }
  std::vector<Vec3> rgb(values.size());
  SampledLight unit = light;
  unit.emission = {1, 0, 0};
  baker.irradiance(chart, std::span(&unit, 1), rgb);
  for (std::size_t i = 0; i < rgb.size(); ++i) values[i] = rgb[i].x;
  return values;
}

class GlConformance : public ::testing::Test {
 protected:
  void SetUp() override { skip_without_driver(BakeDevice::gl); }

  struct Range {
    std::vector<float> least, most;
  };

  /// The rasteriser's answers for the chart moved by up to 1/64 texel.
  static Range moved_by_little(const RasterBaker& cpu, const PlanarChart& chart,
                               const SampledLight& light, bool fractions) {
    const Vec3 right = chart.edge_x / (128 * static_cast<float>(chart.width));
    const Vec3 up = chart.edge_y / (128 * static_cast<float>(chart.height));
    Range range;
    range.least = range.most = baked(cpu, chart, light, fractions);
    for (int k = 0; k < 25; ++k) {
      PlanarChart moved = chart;
      moved.base += right * static_cast<float>(k % 5 - 2) + up * static_cast<float>(k / 5 - 2);
      const std::vector<float> other = baked(cpu, moved, light, fractions);
      for (std::size_t i = 0; i < other.size(); ++i) {
        range.least[i] = std::min(range.least[i], other[i]);
        range.most[i] = std::max(range.most[i], other[i]);
      }
    }
    return range;
  }

  /// A texel may differ where moving it by 1/64 texel moves the rasteriser's answer as far.
  static void compare(const Occluders& occluders, const GlBaker& gl, const PlanarChart& chart,
                      const SampledLight& light, bool fractions) {
    const RasterBaker cpu(occluders);
    const std::vector<float> found = baked(gl, chart, light, fractions);
    const std::vector<float> expected = baked(cpu, chart, light, fractions);
    const auto [least, most] = moved_by_little(cpu, chart, light, fractions);
    std::size_t at_edges = 0, shadowed = 0, wrong = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const float near = 2e-4f * std::max(expected[i], 0.02f);
      shadowed += expected[i] < 0.999f;
      if (std::abs(found[i] - expected[i]) <= near) continue;
      ++at_edges;
      const bool explained = found[i] >= least[i] - near && found[i] <= most[i] + near;
      if (!explained && ++wrong < 5)
        ADD_FAILURE() << i % chart.width << ", " << i / chart.width << ": " << found[i]
                      << ", by the rasteriser " << expected[i] << " in [" << least[i] << ", "
                      << most[i] << "]";
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_LE(at_edges, 1 + found.size() / 50);
    EXPECT_GE(shadowed, 300u);
  }

  static void run(const Scene& scene, const PlanarChart& chart, int samples) {
    const LightViews views(scene);
    const Occluders occluders(scene);
    const GlBaker gl(occluders);
    BakeOptions options;
    options.light_samples = samples;
    const LightSampler sampler(views, options);
    for (std::size_t l = 0; l < scene.lights.size(); ++l)
      for (const bool fractions : {true, false}) {
        SCOPED_TRACE(std::string(to_string(scene.lights[l].type)) +
                     (fractions ? ", fractions" : ", irradiance"));
        compare(occluders, gl, chart, sampler.sample(l, patch_of(chart), fractions), fractions);
      }
  }

  static Scene under_all_lights(Scene scene) {
    for (const LightType type : all_types) scene.lights.push_back(light_of(type));
    return scene;
  }
};

TEST_F(GlConformance, OfTrianglesThatCrossAllPlanes) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene = under_all_lights(triangles_across_all_planes(seed));
    run(scene, chart_of_quad(scene, 0, 97, 70), 9);
  }
}

TEST_F(GlConformance, OnALayoutThatIsMirrored) {
  const Scene scene = under_all_lights(triangles_across_all_planes(5));
  PlanarChart chart = chart_of_quad(scene, 0, 97, 70);
  chart.base += chart.edge_y;
  chart.edge_y = -chart.edge_y;
  run(scene, chart, 9);
}

TEST_F(GlConformance, OfWallsThatStandOnTheReceiver) {
  const Scene scene = under_all_lights(walls_on_the_receiver());
  run(scene, chart_of_quad(scene, 0, 130, 65), 9);
}

TEST_F(GlConformance, OfSpheresBesideInAndUnderTheReceiver) {
  const Scene scene = under_all_lights(spheres_all_round());
  run(scene, chart_of_quad(scene, 0, 97, 70), 9);
}

TEST_F(GlConformance, UnderMeshLights) {
  for (const bool box : {false, true})
    for (const bool double_sided : {false, true}) {
      const Scene scene = lit_by_mesh(box, double_sided);
      run(scene, chart_of_quad(scene, 0, 97, 70), 16);
    }
}

TEST_F(GlConformance, OfLeavesWithHoles) {
  const Scene scene = under_all_lights(leaves_with_holes());
  run(scene, chart_of_quad(scene, 0, 97, 70), 9);
}

TEST_F(GlConformance, OfClosedSurfacesThatReachThroughTheReceiverAndHoldTheLight) {
  for (const bool shade : {false, true}) {
    const Scene scene = closed_surfaces(shade);
    run(scene, chart_of_quad(scene, 0, 97, 70), 9);
  }
}

/// Marks the texels whose centres are within 1/64 texel of the segment from a to b, in texels.
void mark_near(const Vec3d& a, const Vec3d& b, const PlanarChart& chart, std::vector<bool>& near) {
  constexpr double reach = 1.0 / 64;
  const auto first = [](double x) { return static_cast<int>(std::ceil(std::max(x - reach, 0.0))); };
  const auto last = [](double x, int size) {
    return static_cast<int>(std::floor(std::min(x + reach, size - 1.0)));
  };
  const Vec3d along = b - a;
  const double length2 = dot(along, along);
  for (int j = first(std::min(a.y, b.y)); j <= last(std::max(a.y, b.y), chart.height); ++j)
    for (int i = first(std::min(a.x, b.x)); i <= last(std::max(a.x, b.x), chart.width); ++i) {
      const Vec3d to = Vec3d(i, j, 0) - a;
      const double t = length2 > 0 ? std::clamp(dot(to, along) / length2, 0.0, 1.0) : 0;
      const Vec3d off = to - along * t;
      if (dot(off, off) <= reach * reach)
        near[static_cast<std::size_t>(j) * chart.width + static_cast<std::size_t>(i)] = true;
    }
}

/// Texels near an edge of an occluder as the sample sees it, of scenes of triangles.
std::vector<bool> near_edges(const Scene& scene, const PlanarChart& chart,
                             const LightSample& sample) {
  std::vector<bool> near(static_cast<std::size_t>(chart.width) * chart.height);
  const Tile tile(chart, 0, 0, chart.width, chart.height);
  const PyramidToBox m = *pyramid_to_box(Vec3d(sample.position), tile.unit());
  for (std::size_t instance = 1; instance < scene.instances.size(); ++instance) {
    const std::vector<Vec3>& p = scene.meshes[scene.instances[instance].mesh].positions;
    ClipPolygon polygon{3, {m(Vec3d(p[0])), m(Vec3d(p[1])), m(Vec3d(p[2]))}};
    clip(polygon, [](const Vec3d& v) { return v.z - 1e-5; });
    clip(polygon, [](const Vec3d& v) { return 1 - v.z; });
    for (int c = 0; c < polygon.count; ++c)
      polygon.corners[c] = {polygon.corners[c].x / polygon.corners[c].z,
                            polygon.corners[c].y / polygon.corners[c].z, 0};
    for (int c = 0; c < polygon.count; ++c)
      mark_near(polygon.corners[c], polygon.corners[(c + 1) % polygon.count], chart, near);
  }
  return near;
}

/// More than one word, pass and tile.
TEST_F(GlConformance, OfManySamplesOnManyTexels) {
  Scene scene = triangles_across_all_planes(5);
  scene.lights.push_back(light_of(LightType::rect));
  const PlanarChart chart = chart_of_quad(scene, 0, 1100, 17);
  const LightViews views(scene);
  const Occluders occluders(scene);
  const GlBaker gl(occluders);
  BakeOptions options;
  options.light_samples = 270;
  const SampledLight light = LightSampler(views, options).sample(0, patch_of(chart));
  ASSERT_GT(light.samples.size(), 256u);
  const std::vector<float> found = baked(gl, chart, light, false);
  const std::vector<float> expected = baked(RasterBaker(occluders), chart, light, false);
  std::vector<float> at_edges(found.size());
  float sum = 0, open = 0;
  for (const LightSample& sample : light.samples) {
    const std::vector<bool> near = near_edges(scene, chart, sample);
    for (std::size_t i = 0; i < near.size(); ++i) {
      const Vec3 texel = chart.texel(static_cast<float>(i % 1100), static_cast<float>(i / 1100));
      const float whole = irradiance_of(light, sample, texel, chart.normal);
      sum += whole;
      if (near[i]) at_edges[i] += whole, open += whole;
    }
  }
  EXPECT_LT(open, 0.1f * sum);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], at_edges[i] + 2e-4f * expected[i])
        << i % 1100 << ", " << i / 1100;
}

}  // namespace
}  // namespace penumbra::bake
