#include "geometry/cone_tree.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/brute_force.h"
#include "scene/finish.h"

namespace penumbra {
namespace {

using Random = std::mt19937;

float uniform(Random& random, float lo, float hi) {
  return lo + (hi - lo) * static_cast<float>(random() >> 8) * 0x1p-24f;
}
Vec3 point(Random& random, float size) {
  return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}
Vec3 direction(Random& random) {
  for (;;)
    if (const Vec3 p = point(random, 1); dot(p, p) < 1 && dot(p, p) > 0.01f) return normalize(p);
}

Mesh soup(Random& random, int triangles, float size) {
  Mesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const Vec3 center = point(random, 1);
    for (int v = 0; v < 3; ++v) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(center + point(random, size));
    }
  }
  return mesh;
}

Scene scene_of(Mesh mesh) {
  Scene scene;
  scene.materials.emplace_back();
  scene.objects.push_back({"soup"});
  scene.meshes.push_back(std::move(mesh));
  scene.instances.emplace_back();
  return scene;
}

ConeQuery random_query(Random& random) {
  ConeQuery q;
  q.origin = point(random, 1.5f);
  q.direction = direction(random);
  q.horizon = direction(random);
  if (dot(q.horizon, q.direction) < 0) q.horizon = -q.horizon;
  q.epsilon = 1e-6f;
  q.distance = random() % 3 ? uniform(random, 0.2f, 4) : INFINITY;
  q.outer = uniform(random, 0.01f, 1.2f);
  if (std::isfinite(q.distance) && random() % 2) {
    q.has_plane = true;
    q.plane_normal = direction(random);
    if (dot(q.plane_normal, q.direction) > 0) q.plane_normal = -q.plane_normal;
    q.plane_distance = -dot(q.plane_normal, q.direction) * q.distance;
    q.plane_epsilon = 1e-6f;
  }
  return q;
}

double brute_force(const Scene& scene, const ConeQuery& q) {
  double least = q.outer;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
      testing::Polygon p;
      for (std::size_t v = 0; v < 3; ++v)
        p.push_back(instance.world_from_mesh.point(Vec3d(mesh.positions[mesh.indices[t + v]])));
      least = std::min(least, testing::polygon_clearance(p, q));
    }
  }
  for (const Sphere& s : scene.spheres)
    least = std::min(least, testing::sphere_clearance(Vec3d(s.center), s.radius, q));
  return least;
}

void expect_agreement(const Scene& scene, Random& random, int queries,
                      std::size_t most_copied_triangles = 0) {
  const ConeTree tree(scene, most_copied_triangles);
  int found = 0, blocked = 0;
  for (int i = 0; i < queries; ++i) {
    const ConeQuery q = random_query(random);
    ConeCounts counts;
    const float answer = tree.least_clearance(q, SearchLimit::exact(), counts);
    const double truth = brute_force(scene, q);
    found += truth < q.outer, blocked += truth == 0;
    ASSERT_NEAR(answer, truth, 2e-5 * (1 + truth)) << "query " << i;
  }
  EXPECT_GT(found, queries / 50);
  EXPECT_LT(blocked, queries);
}

TEST(ConeTree, AgreesWithBruteForceOnTriangles) {
  Random random(1);
  for (const float size : {0.03f, 0.3f, 2.0f})
    for (const int n : {1, 7, 300}) expect_agreement(scene_of(soup(random, n, size)), random, 400);
}

TEST(ConeTree, AgreesWithBruteForceOnPlacedMeshes) {
  Random random(2);
  Scene scene = scene_of(soup(random, 100, 0.2f));
  const Affine turn_and_shrink{{0, 0.5, 0}, {-0.5, 0, 0}, {0, 0, 0.5}, {0.4, -0.2, 0.1}};
  const Affine mirror{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.3, 0.2, 0}};
  const Affine stretch{{1, 0.5, 0}, {0, 2, 0}, {0, 0, 0.3}, {0, 0, 0.5}};
  for (const Affine& m : {turn_and_shrink, mirror, stretch}) {
    scene.instances.push_back({});
    scene.instances.back().world_from_mesh = m;
  }
  expect_agreement(scene, random, 1000);
  expect_agreement(scene, random, 500, 1 << 17);
}

TEST(ConeTree, AgreesWithThePaperOnSpheres) {
  Random random(3);
  Scene scene;
  scene.materials.emplace_back();
  scene.objects.push_back({"spheres"});
  for (int i = 0; i < 60; ++i)
    scene.spheres.push_back({point(random, 1) + Vec3{0, 3, 0}, uniform(random, 0.02f, 0.2f), 0, 0});
  const ConeTree tree(scene);
  int between = 0;
  for (int i = 0; i < 3000; ++i) {
    ConeQuery q;
    q.origin = {uniform(random, -2, 2), 0, uniform(random, -2, 2)};
    q.direction = normalize(Vec3{uniform(random, -1, 1), 3, uniform(random, -1, 1)});
    q.distance = 40;
    q.horizon = {0, 1, 0};
    q.outer = 0.2f;
    ConeCounts counts;
    const double truth = brute_force(scene, q);
    between += truth > 0 && truth < q.outer;
    ASSERT_NEAR(tree.least_clearance(q, SearchLimit::exact(), counts), truth, 2e-5);
  }
  EXPECT_GT(between, 500);
}

TEST(ConeTree, ObjectsHaveTheirOwnLeastClearance) {
  Random random(4);
  Scene scene = scene_of(soup(random, 40, 0.2f));
  scene.objects.push_back({"second"});
  scene.meshes.push_back(soup(random, 40, 0.2f));
  scene.instances.push_back({1, 0, 1, -1, {}});
  const ConeTree tree(scene);
  for (int i = 0; i < 500; ++i) {
    const ConeQuery q = random_query(random);
    ConeCounts counts;
    std::vector<ObjectClearance> objects;
    tree.object_clearances(q, objects, counts);
    double least = q.outer;
    for (const ObjectClearance& o : objects) least = std::min<double>(least, o.clearance);
    ASSERT_NEAR(least, brute_force(scene, q), 2e-5);
    if (least == 0) continue;
    for (const ObjectClearance& o : objects) {
      Scene alone = scene;
      alone.instances = {scene.instances[o.object]};
      ASSERT_NEAR(o.clearance, brute_force(alone, q), 2e-5);
    }
  }
}

void make_light(Scene& scene, int instance) {
  Light light;
  light.type = LightType::mesh, light.instance = instance;
  scene.lights.push_back(light);
}

TEST(ConeTree, ExcludedInstanceDoesNotOcclude) {
  Random random(5);
  Scene scene = scene_of(soup(random, 40, 0.3f));
  scene.meshes.push_back(soup(random, 40, 0.3f));
  scene.instances.push_back({1, 0, 0, -1, {}});
  Scene without = scene;
  without.instances.pop_back();
  make_light(scene, 1);
  const ConeTree tree(scene);
  for (int i = 0; i < 500; ++i) {
    ConeQuery q = random_query(random);
    q.excluded_instance = 1;
    ConeCounts counts;
    ASSERT_NEAR(tree.least_clearance(q, SearchLimit::exact(), counts), brute_force(without, q),
                2e-5);
  }
}

void expect_without_the_second(Scene scene, Random& random) {
  Scene without = scene;
  without.instances.pop_back();
  make_light(scene, 1);
  const ConeTree tree(scene, 0);
  for (int i = 0; i < 300; ++i) {
    ConeQuery q = random_query(random);
    q.excluded_instance = 1;
    ConeCounts counts;
    ASSERT_NEAR(tree.least_clearance(q, SearchLimit::exact(), counts), brute_force(without, q),
                2e-5);
  }
}

TEST(ConeTree, ALampOccludesForOtherLights) {
  Random random(15);
  Scene scene = scene_of(soup(random, 40, 0.3f));
  scene.meshes.push_back(soup(random, 40, 0.3f));
  scene.instances.push_back({1, 0, 0, -1, {{0, 1, 0}, {-2, 0, 0}, {0, 0, 1}, {0.1, 0, 0}}});
  make_light(scene, 1);
  const ConeTree tree(scene);
  for (int i = 0; i < 300; ++i) {
    const ConeQuery q = random_query(random);
    ConeCounts counts;
    ASSERT_NEAR(tree.least_clearance(q, SearchLimit::exact(), counts), brute_force(scene, q), 2e-5);
  }
}

TEST(ConeTree, ExcludedPlacementsAndCutOutsDoNotOcclude) {
  Random random(6);
  Scene scene = scene_of(soup(random, 40, 0.3f));
  scene.meshes.push_back(soup(random, 40, 0.3f));
  scene.instances.push_back({1, 0, 0, -1, {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {}}});
  expect_without_the_second(scene, random);

  scene.textures.push_back({"opaque", 1, 1, {255, 255, 255, 255}});
  Material cut_out;
  cut_out.diffuse_map.image = 0;
  cut_out.alpha_cutoff = 0.5f;
  scene.materials.push_back(cut_out);
  scene.instances[1].material = 1;
  scene.meshes[1].uv[0].resize(scene.meshes[1].positions.size());
  expect_without_the_second(scene, random);
}

TEST(ConeTree, LowerBoundsOfSpheresAreTheirTangents) {
  Random random(7);
  int found = 0, behind = 0;
  for (int i = 0; i < 2000; ++i) {
    Scene scene;
    scene.materials.emplace_back();
    scene.objects.push_back({"sphere"});
    const float radius = uniform(random, 0.05f, 1);
    scene.spheres.push_back({point(random, 2), radius, 0, 0});
    const Vec3d c(scene.spheres[0].center);
    ConeQuery q;
    q.direction = q.horizon = direction(random);
    q.outer = 2;
    q.lower_bound = true;
    const double away = length(c), along = dot(c, Vec3d(q.direction));
    if (along + radius <= 0.01) continue;
    double truth = 0;
    if (away > radius) {
      const double angle = std::acos(along / away) - std::asin(radius / away);
      if (angle > 0) truth = angle < 1.5 ? std::min(std::tan(angle), 2.0) : 2;
    }
    found += truth > 0 && truth < 2, behind += along < 0 && truth < 2;
    ConeCounts counts;
    ASSERT_NEAR(ConeTree(scene).least_clearance(q, SearchLimit::exact(), counts), truth,
                1e-4 * (1 + truth))
        << "sphere " << i;
  }
  EXPECT_GT(found, 300);
  EXPECT_GT(behind, 30);
}

TEST(ConeTree, EmptySceneIsClear) {
  const Scene scene;
  const ConeTree tree(scene);
  ConeQuery q;
  q.direction = q.horizon = {0, 1, 0};
  q.outer = 0.5f;
  ConeCounts counts;
  EXPECT_EQ(tree.least_clearance(q, SearchLimit::exact(), counts), 0.5f);
}

}  // namespace
}  // namespace penumbra
