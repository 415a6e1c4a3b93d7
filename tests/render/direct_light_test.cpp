#include "render/direct_light.h"

#include <gtest/gtest.h>

#include <numbers>

namespace penumbra {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

Light rect_light(const Vec3& corner, const Vec3& u, const Vec3& v) {
  Light light;
  light.type = LightType::rect;
  light.position = corner + u * 0.5f + v * 0.5f;
  light.edge_u = u;
  light.edge_v = v;
  light.normal = normalize(cross(u, v));
  light.emission = {1, 1, 1};
  return light;
}

/// The parallelogram as a mesh of steps × steps × 2 triangles, and its light.
void add_mesh_light(Scene& scene, const Vec3& corner, const Vec3& u, const Vec3& v, int steps) {
  Mesh mesh;
  const int row = steps + 1;
  for (int j = 0; j <= steps; ++j)
    for (int i = 0; i <= steps; ++i)
      mesh.positions.push_back(corner + u * (float(i) / float(steps)) +
                               v * (float(j) / float(steps)));
  for (int j = 0; j < steps; ++j)
    for (int i = 0; i < steps; ++i)
      for (int k : {0, 1, row + 1, 0, row + 1, row})
        mesh.indices.push_back(static_cast<std::uint32_t>(j * row + i + k));
  Light light;
  light.type = LightType::mesh;
  light.emission = {1, 1, 1};
  light.instance = static_cast<int>(scene.instances.size());
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  scene.meshes.push_back(mesh);
  scene.instances.push_back(instance);
  scene.lights.push_back(light);
}

constexpr Vec3 corner{-0.5f, 2, 0.6f}, edge_u{1.2f, 0.3f, 0}, edge_v{0, 0.1f, -1.4f};

TEST(DirectLight, AMeshOfAQuadIsTheRect) {
  Scene scene;
  const bool down = cross(edge_u, edge_v).y < 0;
  const Vec3 u = down ? edge_u : edge_v, v = down ? edge_v : edge_u;
  scene.lights.push_back(rect_light(corner, u, v));
  add_mesh_light(scene, corner, u, v, 1);
  add_mesh_light(scene, corner, u, v, 5);
  add_mesh_light(scene, corner, u, v, 12);
  const LightViews views(scene);
  const DirectLight lights(views);
  for (const Vec3& n : {Vec3{0, 1, 0}, normalize(Vec3{1, 0.5f, 0}), normalize(Vec3{0, -0.1f, 1})}) {
    const Vec3 p{0.3f, 0.1f, -0.4f};
    const float rect = lights.irradiance(0, p, n, Horizon::exact);
    EXPECT_NEAR(lights.irradiance(1, p, n, Horizon::exact), rect, 2e-6f);
    EXPECT_NEAR(lights.irradiance(2, p, n, Horizon::exact), rect, 1e-5f);
    EXPECT_NEAR(lights.irradiance(3, p, n, Horizon::exact) / std::max(rect, 1e-3f), 1, 0.02f)
        << "288 triangles, by points of the surface";
  }
}

TEST(DirectLight, OneSidedLightsGiveNothingBehind) {
  Scene scene;
  scene.lights.push_back(rect_light(corner, edge_u, edge_v));
  add_mesh_light(scene, corner, edge_u, edge_v, 1);
  Light disk = scene.lights[0];
  disk.type = LightType::disk;
  disk.radius = 0.4f;
  scene.lights.push_back(disk);
  add_mesh_light(scene, corner, edge_u, edge_v, 1);
  scene.lights.back().double_sided = true;
  const LightViews views(scene);
  const DirectLight lights(views);
  const Vec3 n = scene.lights[0].normal, middle = scene.lights[0].position;
  ShadingPoint glossy;
  glossy.position = middle - n;
  glossy.normal = glossy.to_viewer = n;
  for (std::size_t i : {0, 1, 2}) {
    EXPECT_EQ(lights.irradiance(i, middle - n, n, Horizon::exact), 0);
    EXPECT_GT(lights.irradiance(i, middle + n, -n, Horizon::exact), 0.1f);
    EXPECT_EQ(lights.glossy(i, glossy).f0, 0);
  }
  EXPECT_GT(lights.irradiance(3, middle - n, n, Horizon::exact), 0.1f);
  EXPECT_GT(lights.glossy(3, glossy).f0, 0);
}

TEST(DirectLight, AClosedDoubleSidedMeshLightsOnceOnly) {
  Scene scene;
  Mesh box;  // of side 1 round (0, 3, 0)
  for (int i = 0; i < 8; ++i)
    box.positions.push_back({float(i & 1) - 0.5f, float(i >> 1 & 1) + 2.5f, float(i >> 2) - 0.5f});
  box.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  Light light;
  light.type = LightType::mesh;
  light.instance = 0;
  light.double_sided = true;
  scene.meshes.push_back(box);
  scene.instances.emplace_back();
  scene.lights = {light, rect_light({-0.5f, 2.5f, -0.5f}, {1, 0, 0}, {0, 0, 1})};
  const LightViews views(scene);
  const DirectLight lights(views);
  EXPECT_NEAR(lights.irradiance(0, {0, 0, 0}, {0, 1, 0}, Horizon::exact),
              lights.irradiance(1, {0, 0, 0}, {0, 1, 0}, Horizon::exact), 1e-5f);
}

TEST(DirectLight, ASunGivesItsIrradianceWhereItStandsOverhead) {
  Scene scene;
  Light sun;
  sun.type = LightType::sun;
  sun.direction = {0, -1, 0};
  for (float degrees : {0.0f, 0.53f, 5.0f}) {
    sun.angular_diameter = degrees * pi / 180;
    scene.lights.push_back(sun);
  }
  const LightViews views(scene);
  const DirectLight lights(views);
  for (std::size_t i : {0, 1, 2}) {
    EXPECT_NEAR(lights.irradiance(i, {}, {0, 1, 0}, Horizon::exact), 1, 1e-4f);
    EXPECT_NEAR(lights.irradiance(i, {}, normalize(Vec3{1, 1, 0}), Horizon::exact), std::sqrt(0.5f),
                1e-4f);
    EXPECT_EQ(lights.irradiance(i, {}, {0, -1, 0}, Horizon::exact), 0);
  }
}

TEST(DirectLight, ASpotIsFullInsideAndNothingOutside) {
  Scene scene;
  Light spot;
  spot.position = {0, 2, 0};
  spot.normal = {0, -1, 0};
  spot.spot_cos_inner = std::cos(0.3f);
  spot.spot_cos_outer = std::cos(0.5f);
  scene.lights.push_back(spot);
  const LightViews views(scene);
  const DirectLight lights(views);
  const Vec3 up{0, 1, 0};
  EXPECT_NEAR(lights.irradiance(0, {0, 0, 0}, up, Horizon::exact), 0.25f, 1e-6f);
  const float c = std::cos(0.25f);
  EXPECT_NEAR(lights.irradiance(0, {2 * std::tan(0.25f), 0, 0}, up, Horizon::exact),
              0.25f * c * c * c, 1e-5f);
  EXPECT_EQ(lights.irradiance(0, {2 * std::tan(0.51f), 0, 0}, up, Horizon::exact), 0);
}

TEST(DirectLight, ASphereKeepsTheConeOfItsSpot) {
  Scene scene;
  for (const float cos_outer : {-1.0f, std::cos(0.5f)}) {
    Light light;
    light.type = LightType::sphere;
    light.position = {0, 2, 0};
    light.radius = 0.1f;
    light.normal = {0, -1, 0};
    light.spot_cos_inner = cos_outer < 0 ? -1 : std::cos(0.3f);
    light.spot_cos_outer = cos_outer;
    scene.lights.push_back(light);
  }
  const LightViews views(scene);
  const DirectLight lights(views);
  for (const float angle : {0.0f, 0.25f, 0.4f, 0.51f}) {
    ShadingPoint p;
    p.position = {2 * std::tan(angle), 0, 0};
    p.normal = {0, 1, 0};
    p.to_viewer = normalize(Vec3{1, 1, 0});
    p.alpha = 0.3f;
    const float whole = lights.irradiance(0, p.position, p.normal, Horizon::exact);
    const float part = lights.irradiance(1, p.position, p.normal, Horizon::exact) / whole;
    const float expected = angle < 0.3f ? 1 : angle > 0.5f ? 0 : 0.5f;
    EXPECT_NEAR(part, expected, expected == 0.5f ? 0.1f : 1e-6f);
    EXPECT_NEAR(lights.glossy(1, p).f0, part * lights.glossy(0, p).f0, 1e-6f);
  }
}

/// Sums the lobe over a sphere light by brute force.
Glossy brute_sphere_glossy(const Light& light, const ShadingPoint& p) {
  constexpr int rings = 200, spokes = 400;
  const Vec3 to = light.position - p.position;
  const float sin2 = light.radius * light.radius / dot(to, to);
  const float cos_edge = std::sqrt(1 - sin2);
  const Frame f = frame_around(normalize(to));
  Glossy sum;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < spokes; ++j) {
      const float z = cos_edge + (1 - cos_edge) * (float(i) + 0.5f) / rings;
      const float phi = 2 * pi * (float(j) + 0.5f) / spokes, r = std::sqrt(1 - z * z);
      const Vec3 l = f.u * (r * std::cos(phi)) + f.v * (r * std::sin(phi)) + f.w * z;
      sum +=
          ggx(p.alpha * p.alpha, dot(p.normal, p.to_viewer), dot(p.normal, l), dot(p.to_viewer, l));
    }
  return sum * (2 * pi * (1 - cos_edge) / (rings * spokes));
}

TEST(DirectLight, GlossyPointsComeCloseToTheIntegral) {
  Scene scene;
  Light light;
  light.type = LightType::sphere;
  light.position = {0.4f, 2, 0.3f};
  light.radius = 0.5f;
  scene.lights.push_back(light);
  const LightViews views(scene);
  const DirectLight lights(views);
  for (float alpha : {0.1f, 0.3f, 0.8f})
    for (float x : {0.0f, 0.5f, 1.5f}) {
      ShadingPoint p;
      p.position = {x, 0, 0};
      p.normal = {0, 1, 0};
      p.to_viewer = normalize(Vec3{-0.5f, 1, 0.2f});
      p.alpha = alpha;
      const float truth = brute_sphere_glossy(light, p).f0;
      EXPECT_NEAR(lights.glossy(0, p).f0, truth, 0.05f * truth + 0.002f)
          << "alpha " << alpha << " x " << x;
    }
}

TEST(DirectLight, SmoothReflectionOfALightShowsItsRadiance) {
  Scene scene;
  Light light;
  light.type = LightType::sphere;
  light.position = {0, 2, 0};
  light.radius = 0.5f;
  scene.lights.push_back(light);
  ShadingPoint p;
  p.normal = p.to_viewer = {0, 1, 0};
  p.alpha = 0.002f;
  EXPECT_NEAR(DirectLight(LightViews(scene)).glossy(0, p).f0, 1, 0.1f);
}

TEST(DirectLight, IsFiniteAtAndInsideLights) {
  Scene scene;
  for (LightType type :
       {LightType::point, LightType::sphere, LightType::disk, LightType::segment}) {
    Light light;
    light.type = type;
    light.normal = {0, 1, 0};
    light.edge_u = {1, 0, 0};
    light.radius = 0.5f;
    scene.lights.push_back(light);
  }
  scene.lights.push_back(rect_light({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}));
  const LightViews views(scene);
  const DirectLight lights(views);
  for (std::size_t i = 0; i < lights.size(); ++i)
    for (const Vec3& at : {Vec3{0, 0, 0}, Vec3{0.5f, 0, 0}, Vec3{0, 1e-20f, 0}, Vec3{0, 0.1f, 0}})
      for (const Vec3& n : {Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{1, 0, 0}}) {
        SCOPED_TRACE(testing::Message() << to_string(scene.lights[i].type) << " y " << at.y);
        ShadingPoint p;
        p.position = at;
        p.normal = p.to_viewer = n;
        p.alpha = 0.1f;
        EXPECT_TRUE(std::isfinite(lights.irradiance(i, at, n, Horizon::exact)));
        EXPECT_TRUE(std::isfinite(lights.glossy(i, p).f0));
      }
}

}  // namespace
}  // namespace penumbra
