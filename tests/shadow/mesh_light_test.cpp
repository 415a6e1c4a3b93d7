// Which part of an emissive mesh is turned to a point.
#include "shadow/mesh_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "shadow/light_points.h"

namespace penumbra {
namespace {

/// A lumpy ball of 2 · steps² triangles, wound outwards, as an emissive instance.
Scene lumpy_ball(int steps) {
  Scene scene;
  scene.materials.emplace_back();
  scene.objects = {{"ball"}};
  Mesh mesh;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const float a = std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(steps);
      const float b =
          2 * std::numbers::pi_v<float> * static_cast<float>(j % steps) / static_cast<float>(steps);
      const float lump = i % steps == 0 ? 0 : std::sin(5 * a) * std::sin(4 * b);
      const float ring = i % steps == 0 ? 0 : std::sin(a);
      mesh.positions.push_back(Vec3{ring * std::cos(b), std::cos(a), -ring * std::sin(b)} *
                               (1 + 0.2f * lump));
    }
  const auto at = [steps](int i, int j) { return static_cast<std::uint32_t>(i * (steps + 1) + j); };
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j)
      for (const std::uint32_t v :
           {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)})
        mesh.indices.push_back(v);
  scene.meshes.push_back(mesh);
  scene.instances.push_back({0, 0, 0, -1, {}});
  Light light;
  light.type = LightType::mesh, light.instance = 0;
  scene.lights = {light};
  return scene;
}

struct Brute {
  double area = 0;
  Vec3d moment;
};

Brute brute_force(const MeshLight& light, const Vec3& point, bool all) {
  Brute out;
  for (const LightFace& f : light.faces) {
    if (!all && !MeshLight::turned(f, point)) continue;
    out.area += double(f.area);
    out.moment += Vec3d(f.a + f.b + f.c) * (double(f.area) / 3);
  }
  return out;
}

void expect_equal(const MeshLight::Sum& sum, const Brute& truth) {
  EXPECT_NEAR(sum.area, truth.area, 1e-5 * truth.area);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(sum.moment[axis], truth.moment[axis], 2e-5 * truth.area);
}

TEST(MeshLight, FindsEveryFaceThatIsTurnedToAPoint) {
  const Scene scene = lumpy_ball(40);
  const MeshLight light(scene, scene.lights[0]);
  ASSERT_GT(light.faces.size(), 3000u);
  std::mt19937 random(4);
  std::normal_distribution<float> normal;
  int some = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3 way = normalize(Vec3{normal(random), normal(random), normal(random)});
    const Vec3 point = way * std::exp(normal(random));
    std::vector<MeshLight::Run> runs;
    const auto sum = light.seen_from(point, false, &runs);
    const Brute truth = brute_force(light, point, false);
    if (!(truth.area > 0)) continue;
    ++some;
    expect_equal(sum, truth);
    std::vector<bool> listed(light.faces.size());
    for (const auto& run : runs)
      for (std::uint32_t f = run.first; f < run.last; ++f) listed[f] = true;
    for (std::size_t f = 0; f < listed.size(); ++f)
      ASSERT_EQ(listed[f], MeshLight::turned(light.faces[f], point)) << "face " << f;
    EXPECT_FLOAT_EQ(runs.back().area, sum.area);
  }
  EXPECT_GT(some, 200);
}

TEST(MeshLight, PointsFallOnTheTurnedFacesByArea) {
  const Scene scene = lumpy_ball(20);
  const LightViews lights(scene);
  const MeshLight& light = lights.mesh_light(0);
  constexpr int count = 4096;
  const LightSamples samples(count, 3);
  for (const Vec3& from : {Vec3{3, 0.5f, 1}, Vec3{-0.7f, 1.5f, 0.4f}}) {
    std::vector<MeshLight::Run> runs;
    const auto sum = light.seen_from(from, false, &runs);
    ASSERT_GT(runs.size(), 3u);
    const LightPoints points(lights, 0, from, 0);
    Vec3d mean;
    for (int i = 0; i < count; ++i) {
      const float x = (static_cast<float>(i) + 0.5f) / count;
      const auto at = points.on_face(x, 0.5f);
      EXPECT_LT(dot(at.normal, at.to), 1e-4f) << x;
    }
    const SamplePattern pattern = samples.pattern(5);
    for (int i = 0; i < count; ++i) {
      const LightTarget target = points.target(pattern, i);
      mean += Vec3d(from + target.direction * target.t_max) / count;
    }
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(mean[axis], sum.moment[axis] / sum.area, 0.01) << axis;
  }
}

TEST(MeshLight, TakesAllWhereNoneIsTurned) {
  const Scene scene = lumpy_ball(20);
  const MeshLight light(scene, scene.lights[0]);
  EXPECT_TRUE(light.closed);
  std::vector<MeshLight::Run> runs;
  expect_equal(light.seen_from({0, 0, 0}, false, &runs), brute_force(light, {0, 0, 0}, true));
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].last, light.faces.size());
}

TEST(MeshLight, OpenAndDoubleSidedTakesAll) {
  Scene scene = lumpy_ball(20);
  auto& indices = scene.meshes[0].indices;
  indices.resize(indices.size() / 2);
  const MeshLight light(scene, scene.lights[0]);
  EXPECT_FALSE(light.closed);
  expect_equal(light.seen_from({0, 5, 0}, true), brute_force(light, {0, 5, 0}, true));
  expect_equal(light.seen_from({0, 5, 0}, false), brute_force(light, {0, 5, 0}, false));
}

}  // namespace
}  // namespace penumbra
