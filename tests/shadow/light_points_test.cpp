#include "shadow/light_points.h"

#include <gtest/gtest.h>

#include "shadow/shadows.h"

namespace penumbra {
namespace {

constexpr int count = 512;

/// A mesh light that is a thin box without a bottom: a large top and two small sides.
Scene hooded() {
  Scene scene;
  Mesh mesh;
  mesh.positions = {{-1, 3, -1},    {1, 3, -1},    {1, 3, 1},     {-1, 3, 1},
                    {-1, 2.5f, -1}, {-1, 2.5f, 1}, {1, 2.5f, -1}, {1, 2.5f, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3, 0, 3, 5, 0, 5, 4, 1, 6, 7, 1, 7, 2};
  scene.meshes.push_back(mesh);
  scene.materials.emplace_back();
  scene.instances.push_back({});
  Light light;
  light.type = LightType::mesh;
  light.instance = 0;
  scene.lights.push_back(light);
  return scene;
}

Scene lit_by(LightType type) {
  Scene scene;
  Light light;
  light.type = type;
  light.position = {0.5f, 3, 0.2f}, light.normal = {0, -1, 0};
  light.edge_u = {1, 0, 0}, light.edge_v = {0, 0, 1.5f};
  light.radius = 0.4f, light.direction = {0, -1, 0}, light.angular_diameter = 0.2f;
  scene.lights.push_back(light);
  return scene;
}

TEST(LightPoints, PacketsHoldTheTargetsOneByOne) {
  const LightSamples samples(count, 7);
  for (const LightType type : {LightType::sphere, LightType::sun, LightType::disk, LightType::rect,
                               LightType::segment, LightType::point}) {
    const Scene scene = lit_by(type);
    const LightViews lights(scene);
    const LightPoints points(lights, 0, {0.1f, 0, 0}, 1e-6f);
    const SamplePattern pattern = samples.pattern(3);
    const float* x = points.takes_disk() ? pattern.disk_x : pattern.square_x;
    const float* y = points.takes_disk() ? pattern.disk_y : pattern.square_y;
    LightPacket packet;
    points.packet(pattern, x + 16, y + 16, packet);
    for (int k = 0; k < LightPacket::size; ++k) {
      const LightTarget target = points.target(pattern, 16 + k);
      EXPECT_EQ(packet.x[k], target.direction.x);
      EXPECT_EQ(packet.t_max[k], target.t_max);
      EXPECT_EQ(packet.weight[k], target.weight);
      EXPECT_NEAR(length(target.direction), 1, 1e-5f);
    }
  }
}

TEST(LightPoints, LieOnTheLight) {
  const LightSamples samples(count, 7);
  const Vec3 from{0.1f, 0, 0};
  for (const LightType type : {LightType::sphere, LightType::disk, LightType::rect}) {
    const Scene scene = lit_by(type);
    const Light& light = scene.lights.front();
    const LightViews lights(scene);
    const LightPoints points(lights, 0, from, 0);
    const SamplePattern pattern = samples.pattern(3);
    Vec3 mean;
    for (int i = 0; i < count; ++i) {
      const LightTarget target = points.target(pattern, i);
      const Vec3 off = from + target.direction * target.t_max - light.position;
      mean += off / static_cast<float>(count);
      if (type == LightType::sphere) {
        EXPECT_NEAR(length(off), light.radius, 1e-5f);
      } else {
        EXPECT_NEAR(off.y, 0, 1e-5f);
        EXPECT_LE(std::abs(off.x), type == LightType::disk ? 0.4001f : 0.5001f);
        EXPECT_LE(std::abs(off.z), type == LightType::disk ? 0.4001f : 0.7501f);
      }
    }
    EXPECT_NEAR(mean.x, 0, 0.06f);
  }
}

TEST(LightPoints, OfAMeshFallOnTheTurnedFacesByArea) {
  const Scene scene = hooded();
  const LightViews lights(scene);
  const MeshLight& mesh = lights.mesh_light(0);
  ASSERT_EQ(mesh.faces.size(), 6u);
  const LightSamples samples(count, 7);
  for (const Vec3& from : {Vec3{4, 2.8f, 0.1f}, Vec3{0, 0, 0}, Vec3{5, 9, 0}}) {
    const LightPoints points(lights, 0, from, 0);
    const SamplePattern pattern = samples.pattern(3);
    const bool all = std::none_of(mesh.faces.begin(), mesh.faces.end(),
                                  [&](const LightFace& f) { return MeshLight::turned(f, from); });
    float area = 0;
    for (const LightFace& f : mesh.faces) area += all || MeshLight::turned(f, from) ? f.area : 0;
    std::vector<int> hits(mesh.faces.size());
    for (int i = 0; i < count; ++i) {
      const LightTarget target = points.target(pattern, i);
      const Vec3 p = from + target.direction * target.t_max;
      int on = 0;
      for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const LightFace& face = mesh.faces[f];
        const auto inside = [&](const Vec3& a, const Vec3& b) {
          return dot(cross(b - a, p - a), face.normal) > -1e-4f;
        };
        if (std::abs(dot(p - face.a, face.normal)) > 1e-4f || !inside(face.a, face.b) ||
            !inside(face.b, face.c) || !inside(face.c, face.a))
          continue;
        if (!all && !MeshLight::turned(face, from)) continue;
        ++on;
        ++hits[f];
      }
      EXPECT_GE(on, 1) << i;
    }
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const bool counts = all || MeshLight::turned(mesh.faces[f], from);
      const float share = counts ? mesh.faces[f].area / area : 0;
      EXPECT_NEAR(static_cast<float>(hits[f]) / count, share, 0.03f) << f;
    }
  }
}

}  // namespace
}  // namespace penumbra
