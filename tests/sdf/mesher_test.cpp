// Triangles of distance fields.
#include "sdf/mesher.h"

#include <gtest/gtest.h>

#include <map>

#include "base/error.h"
#include "scene/finish.h"
#include "scene/load.h"
#include "sdf/field.h"
#include "sdf/sdf_scenes.h"
#include "sdf/test_meshes.h"

namespace penumbra::test {
namespace {

using sdf::DistanceFunction;
using sdf::mesh_of_field;

DistanceFunction field(const std::function<double(const Vec3d&)>& f) {
  return [=](std::span<const Vec3> points, std::span<float> out) {
    for (std::size_t i = 0; i < points.size(); ++i)
      out[i] = static_cast<float>(f(Vec3d(points[i])));
  };
}

constexpr double voxel = 0.05;

double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    sum += dot(Vec3d(mesh.positions[mesh.indices[i]]),
               cross(Vec3d(mesh.positions[mesh.indices[i + 1]]),
                     Vec3d(mesh.positions[mesh.indices[i + 2]])));
  return sum / 6;
}

void expect_on_surface(const Mesh& mesh, const std::function<double(const Vec3d&)>& f,
                       double size = voxel) {
  double worst = 0;
  for (const Vec3& p : mesh.positions) {
    ASSERT_TRUE(is_finite(p));
    worst = std::max(worst, std::abs(f(Vec3d(p))));
  }
  EXPECT_LT(worst, 1e-4 * size);
}

void expect_closed(const Mesh& mesh) {
  ASSERT_GT(mesh.triangle_count(), 10u);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i)
    ++edges[{mesh.indices[i], mesh.indices[i % 3 == 2 ? i - 2 : i + 1]}];
  int open = 0;
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    open += count != 1 || back == edges.end();
  }
  EXPECT_EQ(open, 0);
}

double sphere(const Vec3d& p) { return length(p - Vec3d(0.1, 0.2, 0.3)) - 1; }
double torus(const Vec3d& p) { return std::hypot(std::hypot(p.x, p.z) - 1, p.y) - 0.4; }
double brick(const Vec3d& p) { return box_distance(p, {-0.5, -0.4, -0.3}, {0.5, 0.6, 0.7}); }
double carved(const Vec3d& p) {
  return std::max(brick(p), 0.45 - length(p - Vec3d(0.5, 0.6, 0.7)));
}

TEST(Mesher, SurfacesAreMetAndClosed) {
  const Bounds box{Vec3(-1.5f), Vec3(1.5f)};
  for (const auto& f : {sphere, torus, brick, carved}) {
    const Mesh mesh = mesh_of_field(field(f), box, {.voxel_size = voxel});
    expect_on_surface(mesh, f);
    expect_closed(mesh);
    EXPECT_GT(volume(mesh), 0.5);
  }
}

TEST(Mesher, VolumeOfABall) {
  const Mesh mesh = mesh_of_field(field(sphere), {Vec3(-1.5f), Vec3(1.5f)}, {.voxel_size = voxel});
  EXPECT_NEAR(volume(mesh) / (4 * std::numbers::pi / 3), 1, 0.002);
}

TEST(Mesher, EdgesAndCornersAreKept) {
  const Mesh mesh = mesh_of_field(field(brick), {Vec3(-1), Vec3(1)}, {.voxel_size = voxel});
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner{i & 1 ? 0.5f : -0.5f, i & 2 ? 0.6f : -0.4f, i & 4 ? 0.7f : -0.3f};
    float nearest = INFINITY;
    for (const Vec3& p : mesh.positions) nearest = std::min(nearest, length(p - corner));
    EXPECT_LT(nearest, 0.02 * voxel) << i;
  }
  EXPECT_NEAR(volume(mesh), 1, 1e-3);
  double worst = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    Vec3 middle;
    for (std::size_t k = 0; k < 3; ++k) middle += mesh.positions[mesh.indices[i + k]] / 3.0f;
    worst = std::max(worst, std::abs(brick(Vec3d(middle))));
  }
  EXPECT_LT(worst, 0.02 * voxel);
}

TEST(Mesher, BoundsCutAndClose) {
  const Bounds box{{-1, -0.5f, -1}, {1, 1, 1}};
  const Mesh mesh =
      mesh_of_field(field([](const Vec3d& p) { return p.y; }), box, {.voxel_size = voxel});
  expect_closed(mesh);
  EXPECT_NEAR(volume(mesh), 2, 0.01);
}

TEST(Mesher, NothingInside) {
  const Mesh mesh = mesh_of_field(field([](const Vec3d& p) { return length(p) + 1; }),
                                  {Vec3(-1), Vec3(1)}, {.voxel_size = voxel});
  EXPECT_EQ(mesh.triangle_count(), 0u);
}

TEST(Mesher, ScaleChangesNothing) {
  for (const double factor : {0.01, 100.0}) {
    const auto f = [=](const Vec3d& p) { return torus(p / factor) * factor; };
    const auto s = static_cast<float>(factor);
    const Mesh mesh =
        mesh_of_field(field(f), {Vec3(-1.5f * s), Vec3(1.5f * s)}, {.voxel_size = voxel * factor});
    expect_on_surface(mesh, f, voxel * factor);
    expect_closed(mesh);
  }
}

template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Mesher, Refusals) {
  EXPECT_EQ(refusal([] { mesh_of_field(field(sphere), {}); }),
            "a distance field can be turned into triangles in a finite box only; give one by "
            "--bounds x0,y0,z0,x1,y1,z1");
  EXPECT_EQ(
      refusal([] {
        mesh_of_field(field(sphere), {Vec3(-1), Vec3(1)},
                      {.voxel_size = 1e-3, .most_bytes = 1 << 20});
      }),
      "--voxel-size: triangles of a distance field of 2 m by voxels of 0.001 m take more than "
      "1 MiB; give larger ones, say --voxel-size 0.002");
  const sdf::Field plane(scene_of(R"({"shape": "plane", "normal": [0, 1, 0], "offset": 0})"));
  EXPECT_EQ(
      refusal([&] { sdf::meshes_of_field(plane, {}); }),
      "the scene's distance field has no end, and this method needs triangles of it; give the "
      "box to keep by --bounds x0,y0,z0,x1,y1,z1");
  const Bounds box{Vec3(-1), Vec3(1)};
  const auto meshes = sdf::meshes_of_field(plane, box, {.voxel_size = voxel});
  ASSERT_EQ(meshes.size(), 1u);
  EXPECT_NEAR(volume(meshes[0].mesh), 4, 0.02);
}

TEST(Mesher, AMeshForEachMaterial) {
  const Scene scene =
      scene_with(R"({"type": "sdf", "material": "a", "root": {"op": "union", "children": [
      {"shape": "sphere", "center": [-1, 0, 0], "radius": 0.5, "material": "a"},
      {"shape": "box", "center": [1, 0, 0], "half_size": [0.4, 0.4, 0.4], "material": "b"}]}},
      {"type": "sdf", "material": "b", "root": {"shape": "sphere", "center": [0, 2, 0], "radius": 0.5}})");
  const auto meshes = sdf::meshes_of_field(sdf::Field(scene), {}, {.voxel_size = voxel});
  ASSERT_EQ(meshes.size(), 3u);
  const double ball = std::numbers::pi / 6;
  EXPECT_NEAR(volume(meshes[0].mesh), ball, 0.01 * ball);
  EXPECT_NEAR(volume(meshes[1].mesh), 0.512, 0.001);
  EXPECT_NEAR(volume(meshes[2].mesh), ball, 0.01 * ball);
  EXPECT_EQ(meshes[2].object, 1u);
  for (const auto& part : meshes) expect_closed(part.mesh);
  EXPECT_NE(meshes[0].material, meshes[1].material);
  EXPECT_EQ(meshes[1].material, meshes[2].material);
}

// Its net has triangles that collapse.
TEST(Mesher, EveryTriangleHasArea) {
  const Scene scene = load_scene(PENUMBRA_SOURCE_DIR "/scenes/moving-lamp.json");
  for (const auto& part : sdf::meshes_of_field(sdf::Field(scene), {})) {
    const auto& p = part.mesh.positions;
    for (std::size_t i = 0; i < part.mesh.indices.size(); i += 3) {
      const std::uint32_t* corner = &part.mesh.indices[i];
      EXPECT_FALSE(has_no_area(p[corner[0]], p[corner[1]], p[corner[2]]));
    }
  }
}

}  // namespace
}  // namespace penumbra::test
