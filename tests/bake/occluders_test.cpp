#include "bake/occluders.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "bake/closed_mesh.h"

namespace penumbra::bake {
namespace {

Scene soup(int triangles) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> any(-1, 1);
  Scene scene;
  scene.materials.emplace_back();
  Mesh mesh;
  for (int i = 0; i < 3 * triangles; ++i) {
    mesh.positions.push_back({any(random), any(random), any(random)});
    mesh.indices.push_back(static_cast<std::uint32_t>(i));
  }
  scene.meshes.push_back(mesh);
  scene.instances.emplace_back();
  return scene;
}

TEST(Occluders, HoldEachTriangleOnceWithinTheBoxesAboveIt) {
  for (const int n : {1, 8, 9, 64, 65, 500, 4097}) {
    const Scene scene = soup(n);
    const Occluders occluders(scene);
    std::set<std::uint32_t> seen;
    for (std::size_t c = 0; c < occluders.clusters().size(); ++c) {
      const TriangleCluster& cluster = occluders.clusters()[c];
      for (int lane = 0; lane < cluster.count; ++lane) {
        EXPECT_TRUE(seen.insert(cluster.triangle[lane]).second);
        for (int corner = 0; corner < 3; ++corner)
          for (int axis = 0; axis < 3; ++axis) {
            const float x = cluster.corner[corner][axis][lane];
            EXPECT_EQ(x, scene.meshes[0].positions[3 * cluster.triangle[lane] + corner][axis]);
            std::size_t node = c;
            for (const auto& level : occluders.levels()) {
              EXPECT_GE(x, level[node / 8].lo[axis][node % 8]);
              EXPECT_LE(x, level[node / 8].hi[axis][node % 8]);
              node /= 8;
            }
            EXPECT_EQ(node, 0u);
          }
      }
    }
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(n));
    EXPECT_EQ(occluders.levels().back().size(), 1u);
  }
}

TEST(Occluders, OfNothingAreNone) {
  const Scene scene;
  const Occluders occluders(scene);
  EXPECT_TRUE(occluders.levels().empty());
}

/// Corners are not shared: every face has its own.
Mesh tetrahedron() {
  const Vec3 p[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Mesh mesh;
  for (const int i : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) {
    mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.push_back(p[i]);
  }
  return mesh;
}

TEST(OuterSide, IsWhereTheVolumeSays) {
  Mesh mesh = tetrahedron();
  EXPECT_EQ(outer_side(mesh), 1);
  for (std::size_t t = 0; t < 12; t += 3) std::swap(mesh.indices[t], mesh.indices[t + 1]);
  EXPECT_EQ(outer_side(mesh), -1);
}

TEST(OuterSide, IsUnknownOfOpenAndIllWoundMeshes) {
  Mesh open = tetrahedron();
  open.indices.resize(9);
  EXPECT_EQ(outer_side(open), 0);
  Mesh twisted = tetrahedron();
  std::swap(twisted.indices[0], twisted.indices[1]);
  EXPECT_EQ(outer_side(twisted), 0);
  Mesh cracked = tetrahedron();
  cracked.positions[0].x += 1e-6f;
  EXPECT_EQ(outer_side(cracked), 0);
  EXPECT_EQ(outer_side(Mesh()), 0);
}

}  // namespace
}  // namespace penumbra::bake
