// Distances to meshes against known ones and against brute force.
#include "sdf/mesh_grid.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.h"
#include "scene/load.h"
#include "sdf/test_meshes.h"

namespace penumbra::test {
namespace {

using sdf::GridOptions;
using sdf::MeshGrid;

constexpr double voxel_share = 1.0 / 32;  // of the longest side: grids of the tests are small

Bounds box_of(const Mesh& mesh) {
  Bounds box;
  for (const std::uint32_t i : mesh.indices) box.grow(mesh.positions[i]);
  return box;
}

float longest(const Mesh& mesh) { return max_component(box_of(mesh).size()); }

MeshGrid grid_of(const Mesh& mesh, double share = voxel_share) {
  return MeshGrid(mesh, {.voxel_size = share * longest(mesh)});
}

/// `truth` is exact. Nothing may be farther from 0, and near the surface all must be the same.
void expect_distances(const Mesh& mesh, const std::function<double(const Vec3d&)>& truth,
                      double rounding = 3e-6) {
  const MeshGrid grid = grid_of(mesh);
  const float side = longest(mesh);
  const double voxel = grid.voxel_size();
  int too_far = 0, too_near = 0, inexact = 0, wrong_sign = 0, exact = 0;
  for (const float reach : {0.6f, 2.0f, 100.0f})
    for (const Vec3& p : points_about(box_of(mesh).center(), reach * side, 3000)) {
      const double d = truth(Vec3d(p)), found = grid.distance(p);
      ASSERT_TRUE(std::isfinite(found));
      const double error = rounding * std::max<double>(side, std::abs(d));
      too_far += std::abs(found) > std::abs(d) + error;
      too_near += std::abs(found) < 0.7 * std::abs(d) - error;
      wrong_sign += std::abs(d) > error && (d < 0) != (found < 0);
      if (std::abs(d) > 2 * voxel) continue;
      ++exact;
      inexact += std::abs(found - d) > error;
    }
  EXPECT_EQ(too_far, 0);
  EXPECT_EQ(too_near, 0);
  EXPECT_EQ(wrong_sign, 0);
  EXPECT_EQ(inexact, 0);
  EXPECT_GT(exact, 20);
}

double signed_brute(const Mesh& mesh, const Vec3d& p, double threshold = 0.5) {
  return brute_distance(mesh, p) * (brute_winding(mesh, p) > threshold ? -1 : 1);
}

TEST(MeshGrid, Box) {
  const Vec3 lo{-0.5f, 0.25f, -1}, hi{0.5f, 1, 1};
  expect_distances(box_mesh(lo, hi),
                   [&](const Vec3d& p) { return box_distance(p, Vec3d(lo), Vec3d(hi)); });
}

TEST(MeshGrid, BallAndTorusAreTheirTriangles) {
  for (const Mesh& mesh : {ball_mesh(1, 10), torus_mesh(1, 0.4, 20, 10)})
    expect_distances(mesh, [&](const Vec3d& p) { return signed_brute(mesh, p); });
}

TEST(MeshGrid, FineBallAndTorusAreNearlyRound) {
  const MeshGrid ball = grid_of(ball_mesh(1, 40)), torus = grid_of(torus_mesh(1, 0.4, 80, 40));
  for (const Vec3& p : points_about({}, 1.5f, 3000)) {
    const Vec3d q(p);
    const double r = length(q);
    const double d_ball = r - 1, in_doubt = r < 0.2 ? 0.92 * ball.voxel_size() : 0;
    EXPECT_NEAR(ball.distance(p), d_ball, 0.006 + 0.05 * std::abs(d_ball) + in_doubt);
    const Vec3d ring{std::hypot(q.x, q.z) - 1, q.y, 0};
    const double d = length(ring) - 0.4;
    if (std::abs(d) < 0.2) {
      EXPECT_NEAR(torus.distance(p), d, 0.01);
    }
  }
}

TEST(MeshGrid, GradientIsUnitAndLeadsAway) {
  const Mesh mesh = torus_mesh(1, 0.4, 40, 20);
  const MeshGrid grid = grid_of(mesh);
  for (const Vec3& p : points_about({}, 1.5f, 500)) {
    const Vec3 g = grid.gradient(p);
    EXPECT_NEAR(length(g), 1, 1e-5);
    const double d = signed_brute(mesh, Vec3d(p));
    EXPECT_NEAR(brute_distance(mesh, Vec3d(p - g * static_cast<float>(d))), 0, 1e-5);
  }
  const Vec3 on_face = (mesh.positions[0] + mesh.positions[1] + mesh.positions[42]) / 3.0f;
  EXPECT_GT(dot(grid.gradient(on_face), normalize(on_face)), 0.9f);
}

TEST(MeshGrid, RangeHoldsWhatIsInTheBall) {
  for (const Mesh& mesh : {torus_mesh(1, 0.4, 20, 10), ball_mesh(1, 8)}) {
    const MeshGrid grid = grid_of(mesh);
    for (const Vec3& c : points_about({}, 3, 300)) {
      const float radius = 0.05f + 0.2f * std::abs(c.x);
      const sdf::DistanceRange range = grid.range(c, radius);
      for (const Vec3& p : points_about(c, radius / 1.8f, 30)) {
        EXPECT_GE(grid.distance(p), range.lo);
        EXPECT_LE(grid.distance(p), range.hi);
      }
    }
  }
}

TEST(MeshGrid, OpenSheetHasTwoOutsides) {
  const Mesh sheet = mesh_of({{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}, {0, 2, 1, 0, 3, 2});
  expect_distances(sheet, [&](const Vec3d& p) { return brute_distance(sheet, p); });
  EXPECT_FALSE(grid_of(sheet).is_closed());
}

TEST(MeshGrid, AHoleLeavesTheInsideInside) {
  Mesh ball = ball_mesh(1, 24);
  ball.indices.resize(ball.indices.size() - 6 * 100);  // about one pole
  const MeshGrid grid = grid_of(ball);
  EXPECT_FALSE(grid.is_closed());
  int wrong = 0;
  for (const Vec3& p : points_about({}, 1.3f, 3000)) {
    const double w = brute_winding(ball, Vec3d(p)), d = brute_distance(ball, Vec3d(p));
    EXPECT_LE(std::abs(grid.distance(p)), d * 1.00001 + 1e-5);
    if (std::abs(w - 0.6) > 0.15) wrong += (w > 0.6) != (grid.distance(p) < 0);
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_LT(grid.distance({0.05f, 0.02f, 0}), -0.8f);
}

TEST(MeshGrid, MeshesThatCutOneAnotherAreOneSolid) {
  Mesh mesh = box_mesh({-1, -0.5f, -0.5f}, {1, 0.5f, 0.5f});
  append(mesh, box_mesh({-0.5f, -1, -0.45f}, {0.5f, 1, 0.45f}));
  append(mesh, torus_mesh(0.6, 0.3, 16, 8));
  expect_distances(mesh, [&](const Vec3d& p) { return signed_brute(mesh, p); });
}

TEST(MeshGrid, NoTriangleIsInfinitelyFar) {
  const MeshGrid grid(mesh_of({}, {}));
  EXPECT_EQ(grid.distance({1, 2, 3}), INFINITY);
  EXPECT_EQ(grid.gradient({1, 2, 3}), Vec3(0, 1, 0));
}

TEST(MeshGrid, OneTriangle) {
  const Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0.2f, 0.1f, 0.7f}}, {0, 1, 2});
  expect_distances(mesh, [&](const Vec3d& p) { return brute_distance(mesh, p); });
}

TEST(MeshGrid, TrianglesWithoutArea) {
  const Mesh line = mesh_of({{0, 0, 0}, {1, 0, 0}, {0.5f, 0, 0}}, {0, 1, 2});
  expect_distances(line, [&](const Vec3d& p) { return brute_distance(line, p); });
  const MeshGrid point(mesh_of({{1, 1, 1}}, {0, 0, 0}), {.voxel_size = 0.1});
  EXPECT_NEAR(point.distance({1, 1.25f, 1}), 0.25f, 1e-5f);
}

TEST(MeshGrid, ScaleChangesNothing) {
  const Mesh torus = torus_mesh(1, 0.4, 20, 10);
  const MeshGrid one = grid_of(torus);
  for (const float factor : {0.01f, 100.0f}) {
    const MeshGrid other = grid_of(scaled(torus, factor));
    for (const Vec3& p : points_about({}, 3, 2000))
      EXPECT_NEAR(other.distance(p * factor) / factor, one.distance(p), 2e-3);
  }
}

TEST(MeshGrid, SaysWhatTakesTooMuch) {
  const Mesh mesh = ball_mesh(1, 8);
  try {
    const MeshGrid grid(mesh, {.voxel_size = 0.01, .most_bytes = 1 << 20});
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "--voxel-size: the distances to mesh \"m\" by voxels of 0.01 m take more than 1 "
                 "MiB; give larger ones, say --voxel-size 0.02");
  }
  EXPECT_THROW(MeshGrid(mesh, {.voxel_size = 1e-9}), InputError);
}

TEST(MeshGrid, SignsOfRealModels) {
  const std::string folder = std::string(PENUMBRA_SHARED_DIR) + "/models/";
  if (!std::filesystem::exists(folder + "spot.obj")) GTEST_SKIP() << "no models at hand";
  const Mesh spot = read_model(folder + "spot.obj").meshes.at(0);
  const MeshGrid grid = grid_of(spot, 1.0 / 64);
  EXPECT_TRUE(grid.is_closed());
  int wrong = 0, inside = 0;
  for (const Vec3& p : points_about(box_of(spot).center(), 0.55f * longest(spot), 1000)) {
    const double d = signed_brute(spot, Vec3d(p));
    wrong += (d < 0) != (grid.distance(p) < 0) && std::abs(d) > 1e-6;
    inside += d < 0;
    EXPECT_LE(std::abs(grid.distance(p)), std::abs(d) + 3e-6 * longest(spot));
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(inside, 50);
}

}  // namespace
}  // namespace penumbra::test
