// Many receivers at once must be answered as one by one.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "geometry/cone_batch.h"
#include "shadow/oracle.h"

namespace penumbra::testing {
namespace {

std::vector<Visibility> together(const Shadows& shadows, const std::vector<Receiver>& receivers,
                                 std::size_t light) {
  std::vector<Visibility> out(receivers.size());
  std::vector<std::uint64_t> streams(receivers.size());
  std::iota(streams.begin(), streams.end(), 0);
  ShadowCounts counts;
  shadows.visibilities(receivers, light, streams, out, counts);
  return out;
}

/// The most that any answer differs from that of the receiver alone.
float worst_difference(const World& world, const ShadowOptions& options,
                       const std::vector<Receiver>& receivers, std::size_t light) {
  const Shadows shadows(world, options);
  const auto all = together(shadows, receivers, light);
  float worst = 0;
  ShadowCounts counts;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const float alone = shadows.visibility(receivers[i], light, i, counts).fraction;
    worst = std::max(worst, std::abs(alone - all[i].fraction));
  }
  return worst;
}

ShadowOptions options_of(ShadowKind kind, float tolerance = 0) {
  ShadowOptions options;
  options.kind = kind;
  options.tolerance = tolerance;
  options.light_samples = 16;
  return options;
}

class Groups : public ::testing::TestWithParam<std::string> {};

TEST_P(Groups, AnswerAsOneByOne) {
  const Oracle oracle(GetParam());
  const World world(oracle.scene);
  for (std::size_t light = 0; light < oracle.scene.lights.size(); ++light) {
    std::vector<Receiver> receivers;
    for (const OraclePoint& p : oracle.points)
      if (p.light == light) receivers.push_back(p.receiver);
    EXPECT_LT(worst_difference(world, options_of(ShadowKind::parker), receivers, light), 1e-6f);
    EXPECT_LE(worst_difference(world, options_of(ShadowKind::parker, 0.02f), receivers, light),
              0.0201f);
    EXPECT_EQ(worst_difference(world, options_of(ShadowKind::hard), receivers, light), 0);
    EXPECT_EQ(worst_difference(world, options_of(ShadowKind::area), receivers, light), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Oracle, Groups, ::testing::ValuesIn(oracle_names()),
                         [](const auto& which) {
                           std::string name = which.param;
                           std::erase(name, '-');
                           return name;
                         });

using Random = std::mt19937;

float uniform(Random& random, float lo, float hi) {
  return lo + (hi - lo) * static_cast<float>(random() >> 8) * 0x1p-24f;
}
Vec3 in_box(Random& random, float half) {
  return {uniform(random, -half, half), uniform(random, -half, half), uniform(random, -half, half)};
}

/// A lamp amid the scene, on a triangle of its own plane.
Light lamp_on_ceiling(Mesh& mesh) {
  Light lamp;
  lamp.type = LightType::disk, lamp.position = {0.1f, 0.2f, -0.1f}, lamp.radius = 0.1f;
  lamp.normal = normalize(Vec3{0.3f, -1, 0.2f});
  const Frame frame = frame_around(lamp.normal);
  for (const Vec2& at : {Vec2{-0.4f, -0.3f}, Vec2{0.5f, -0.2f}, Vec2{0, 0.5f}}) {
    mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.push_back(lamp.position + frame.u * at.x + frame.v * at.y);
  }
  return lamp;
}

/// Small triangles and spheres all over, and a light of each kind that has a place.
Scene litter(Random& random) {
  Scene scene;
  scene.materials.emplace_back();
  scene.objects = {{"triangles"}, {"spheres"}, {"placed"}};
  Mesh mesh;
  for (std::uint32_t t = 0; t < 600; ++t) {
    const Vec3 at = in_box(random, 1);
    for (std::uint32_t v = 0; v < 3; ++v) {
      mesh.positions.push_back(at + in_box(random, 0.08f));
      mesh.indices.push_back(3 * t + v);
    }
  }
  const Light lamp = lamp_on_ceiling(mesh);
  scene.meshes.push_back(mesh);
  scene.instances.push_back({0, 0, 0, -1, {}});
  for (int i = 0; i < 40; ++i)
    scene.spheres.push_back({in_box(random, 1), uniform(random, 0.01f, 0.1f), 0, 1});
  Light sphere;
  sphere.type = LightType::sphere, sphere.position = {0.3f, 2.5f, 0.2f}, sphere.radius = 0.3f;
  Light inside = sphere;
  inside.position = {0, 0, 0}, inside.radius = 0.05f;
  Light disk = sphere;
  disk.type = LightType::disk, disk.normal = {0, -1, 0};
  Light sun;
  sun.type = LightType::sun, sun.direction = normalize(Vec3{0.3f, -1, 0.2f});
  sun.angular_diameter = 0.1f;
  Light point;
  point.position = {0, 2, 0};
  scene.lights = {sphere, inside, disk, sun, point, lamp};
  return scene;
}

/// In clusters, as neighbouring pixels see them; each cluster with a normal of its own, or each
/// point.
std::vector<Receiver> clusters(Random& random, std::size_t count) {
  std::vector<Receiver> out;
  while (out.size() < count) {
    const Vec3 at = in_box(random, 1.2f);
    const Vec3 normal = normalize(in_box(random, 1) + Vec3{0, 1.2f, 0});
    const float size = std::exp(uniform(random, -8, 0));
    const float lean = random() % 2 ? 0.0f : random() % 2 ? 0.5f : 2.0f;
    for (int i = 0; i < 50 && out.size() < count; ++i) {
      const Vec3 off = in_box(random, size);
      out.push_back(
          {at + off - normal * dot(off, normal), normalize(normal + in_box(random, lean))});
    }
  }
  return out;
}

TEST(Groups, LitterIsSeenAsOneByOne) {
  Random random(5);
  const Scene scene = litter(random);
  const World world(scene);
  for (const std::size_t count : {1u, 2u, 5u, 8u, 9u, 63u, 1024u, 3000u}) {
    const auto receivers = clusters(random, count);
    for (std::size_t light = 0; light < scene.lights.size(); ++light) {
      EXPECT_LT(worst_difference(world, options_of(ShadowKind::parker), receivers, light), 1e-5f)
          << count << " receivers, light " << light;
      EXPECT_EQ(worst_difference(world, options_of(ShadowKind::hard), receivers, light), 0)
          << count << " receivers, light " << light;
    }
  }
}

TEST(Groups, PlacedMeshesAreSeenAsOneByOne) {
  Random random(6);
  Scene scene = litter(random);
  scene.instances[0].world_from_mesh.t = {0.2, 0.1, 0};
  scene.instances.push_back({0, 0, 2, -1, scene.instances[0].world_from_mesh});
  scene.instances[1].world_from_mesh.t = {-0.7, 0, 0.4};
  const World world(scene);
  const ConeTree placed(scene, 0), copied(scene);
  const auto receivers = clusters(random, 500);
  std::vector<ConeQuery> queries;
  ConeBatch batch;
  batch.clear(receivers.size(), false, -1);
  for (const Receiver& r : receivers) {
    ConeQuery q;
    const Vec3 to = scene.lights[0].position - r.position;
    if (dot(to, r.normal) <= 0) continue;  // below its horizon: nobody asks
    q.origin = r.position, q.horizon = r.normal, q.epsilon = 1e-6f;
    q.distance = length(to), q.direction = to / q.distance, q.outer = 0.6f / q.distance;
    queries.push_back(q), batch.push_back(q);
  }
  std::vector<float> group(queries.size());
  ConeCounts counts;
  int found = 0;
  for (const ConeTree* tree : {&placed, &copied}) {
    tree->least_clearances(batch, SearchLimit::exact(), group, counts);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const float alone = copied.least_clearance(queries[i], SearchLimit::exact(), counts);
      ASSERT_NEAR(group[i], alone, 1e-4f * queries[i].outer + 1e-6f) << i;
      found += alone > 0 && alone < queries[i].outer;
    }
  }
  EXPECT_GT(found, 100);
}

/// A square of 0.6 m that faces down and shines, at a height.
void add_lamp(Scene& scene, float height) {
  Mesh mesh;
  mesh.positions = {{-0.3f, 0, -0.3f}, {0.3f, 0, -0.3f}, {0.3f, 0, 0.3f}, {-0.3f, 0, 0.3f}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  for (Vec3& p : mesh.positions) p = p + Vec3{0, height, 0};
  Light light;
  light.type = LightType::mesh, light.instance = static_cast<int>(scene.instances.size());
  scene.instances.push_back({static_cast<std::uint32_t>(scene.meshes.size()), 0, 0, -1, {}});
  scene.meshes.push_back(mesh);
  scene.lights.push_back(light);
}

TEST(Groups, OneLampStandsInTheLightOfAnother) {
  Scene scene;
  scene.materials.emplace_back();
  scene.objects = {{"lamps"}};
  add_lamp(scene, 3), add_lamp(scene, 1.5f);
  const World world(scene);
  std::vector<Receiver> floor;
  for (int i = 0; i < 1024; ++i)
    floor.push_back(
        {{0.05f * static_cast<float>(i % 32) - 0.8f, 0, 0.05f * static_cast<float>(i / 32) - 0.8f},
         {0, 1, 0}});
  const ShadowOptions parker = options_of(ShadowKind::parker);
  EXPECT_LT(worst_difference(world, parker, floor, 0), 1e-5f);
  EXPECT_LT(worst_difference(world, parker, floor, 1), 1e-5f);
  const Shadows shadows(world, parker);
  const auto behind = together(shadows, floor, 0), before = together(shadows, floor, 1);
  EXPECT_EQ(behind[16 * 32 + 14].fraction, 0);
  for (const Visibility& v : before) EXPECT_EQ(v.fraction, 1);
}

TEST(Groups, NothingIsLookedAtTwiceForAnEmptyPartOfTheScene) {
  // A tile of a floor with nothing above it is free by one walk of a few nodes.
  const Oracle oracle("three-spheres");
  const World world(oracle.scene);
  std::vector<Receiver> tile;
  for (int i = 0; i < 1024; ++i)
    tile.push_back({{3.5f + 0.0004f * static_cast<float>(i % 32), 0,
                     3.5f + 0.0004f * static_cast<float>(i / 32)},
                    {0, 1, 0}});
  const Shadows shadows(world, options_of(ShadowKind::parker));
  std::vector<Visibility> out(tile.size());
  const std::vector<std::uint64_t> streams(tile.size());
  ShadowCounts counts;
  shadows.visibilities(tile, 0, streams, out, counts);
  EXPECT_LE(counts.cone_nodes, 20u);
  EXPECT_EQ(counts.cone_leaves, 0u);
  for (const Visibility& v : out) EXPECT_EQ(v.fraction, 1);
}

}  // namespace
}  // namespace penumbra::testing
