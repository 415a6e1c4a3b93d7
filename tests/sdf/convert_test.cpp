// Distances to placed meshes, and what is said of conversions.
#include "sdf/convert.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "sdf/test_meshes.h"
#include "support/temporary_folder.h"

namespace penumbra::test {
namespace {

Scene scene_with(const Mesh& mesh, const std::vector<Affine>& places) {
  Scene scene;
  scene.meshes.push_back(mesh);
  for (const Affine& place : places) scene.instances.push_back({.world_from_mesh = place});
  return scene;
}

float distance(const sdf::MeshDistance& mesh, const Vec3& p) {
  float d;
  mesh.distance(&p.x, &p.y, &p.z, 1, &d);
  return d;
}

TEST(Convert, PlacedMeshesHaveTheirDistances) {
  const Vec3 lo{-0.5f, -0.25f, -1}, hi{0.5f, 0.25f, 1};
  const Affine turned{{0, 0, -2}, {0, 2, 0}, {2, 0, 0}, {3, 1, 0}};
  const Affine stretched{{1, 0, 0}, {0, 3, 0}, {0, 0, -1}, {0, 0, 5}};
  const Scene scene = scene_with(box_mesh(lo, hi), {{}, turned, stretched});
  const auto make = sdf::mesh_distances({.voxel_size = 0.1});
  const Vec3d boxes[3][2] = {
      {Vec3d(lo), Vec3d(hi)}, {{1, 0.5, -1}, {5, 1.5, 1}}, {{-0.5, -0.75, 4}, {0.5, 0.75, 6}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto mesh = make(scene, i);
    const Vec3 middle((boxes[i][0] + boxes[i][1]) * 0.5);
    for (const Vec3& p : points_about(middle, 2, 500)) {
      const double d = box_distance(Vec3d(p), boxes[i][0], boxes[i][1]);
      EXPECT_NEAR(distance(*mesh, p), d, std::abs(d) < 0.2 ? 1e-5 : 0.15 * std::abs(d)) << i;
      const sdf::DistanceRange range = mesh->range(p, 0.1f);
      EXPECT_LE(range.lo, distance(*mesh, p));
      EXPECT_GE(range.hi, distance(*mesh, p));
    }
  }
}

TEST(Convert, IsToldAndKeptBesideTheFile) {
  const TemporaryFolder folder;
  Mesh mesh = box_mesh({0, 0, 0}, {1, 2, 4});
  mesh.name = "brick", mesh.file = folder / "brick.obj";
  const Scene scene = scene_with(mesh, {{}});
  EXPECT_THAT(sdf::describe_conversions(scene, {}),
              testing::ElementsAre("mesh \"brick\" has distances by a grid of 0.03125 m voxels"));
  sdf::mesh_distances({})(scene, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "brick.obj.0.distance.vdb"));
  EXPECT_THAT(
      sdf::describe_conversions(scene, {}),
      testing::ElementsAre("mesh \"brick\" has distances by a grid of 0.03125 m voxels (cached)"));
  EXPECT_THAT(sdf::describe_conversions(scene, {.voxel_size = 0.5}),
              testing::ElementsAre("mesh \"brick\" has distances by a grid of 0.5 m voxels"));
}

}  // namespace
}  // namespace penumbra::test
