// What a hit means: sides, vertex normals, and the smooth surface that they describe.
#include <gtest/gtest.h>

#include "geometry/world.h"

namespace penumbra {
namespace {

// A triangle of the unit sphere about the axis z, with the sphere's normals, seen from outside.
Scene facet(const Affine& world_from_mesh) {
  Scene scene;
  scene.materials.emplace_back();
  scene.objects.push_back({"facet"});
  Mesh mesh;
  mesh.positions = {normalize(Vec3{0.5f, -0.3f, 1}), normalize(Vec3{0, 0.6f, 1}),
                    normalize(Vec3{-0.5f, -0.3f, 1})};
  mesh.normals = mesh.positions;
  mesh.indices = {0, 1, 2};
  scene.meshes.push_back(mesh);
  scene.instances.emplace_back().world_from_mesh = world_from_mesh;
  return scene;
}

Surface seen_from(const Scene& scene, float z) {
  const World world(scene, {.cone_tree = false});
  const Ray ray{{0, 0, z}, {0, 0, z > 0 ? -1.0f : 1.0f}};
  const auto hit = world.intersect(ray);
  EXPECT_TRUE(hit);
  return world.surface(ray, *hit);
}

TEST(Surface, SidesAndNormalsStayWhereAMirroringPutsThem) {
  const Affine mirror{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}};
  for (const Affine& m : {Affine{}, mirror}) {
    const Surface outside = seen_from(facet(m), 3), inside = seen_from(facet(m), -3);
    EXPECT_TRUE(outside.front);
    EXPECT_FALSE(inside.front);
    EXPECT_TRUE(outside.smooth);
    EXPECT_GT(outside.normal.z, 0.9f);
    EXPECT_LT(inside.normal.z, -0.9f);
    EXPECT_GT(outside.shading_normal.z, 0.99f);
    EXPECT_LT(inside.shading_normal.z, -0.99f);
  }
}

TEST(Surface, SmoothPositionsAreLiftedOutOfAConvexFacetOnly) {
  const Surface outside = seen_from(facet({}), 3), inside = seen_from(facet({}), -3);
  EXPECT_LT(outside.position.z, 0.95f);
  EXPECT_GT(outside.smooth_position.z, outside.position.z + 0.02f);
  EXPECT_LT(outside.smooth_position.z, 1.1f);
  // From within the surface is concave: the point is not pushed below the facet.
  EXPECT_EQ(inside.smooth_position, inside.position);
}

}  // namespace
}  // namespace penumbra
