#include "render/camera_rays.h"

#include <gtest/gtest.h>

namespace penumbra {
namespace {

Camera looking_down_z() {
  Camera camera;
  camera.position = {0, 0, 5};
  camera.look_at = {0, 0, 0};
  camera.vertical_fov = 2 * std::atan(0.5f);
  return camera;
}

void expect_near(const Vec3& a, const Vec3& b) { EXPECT_LT(length(a - b), 1e-5f); }

TEST(CameraRays, TheMiddleLooksAtTheTarget) {
  const CameraRay ray = CameraRays(looking_down_z(), 200, 100).at(100, 50);
  expect_near(ray.ray.origin, {0, 0, 5});
  expect_near(ray.ray.direction, {0, 0, -1});
}

TEST(CameraRays, TheTopEdgeIsHalfTheVerticalFieldOfView) {
  const CameraRays rays(looking_down_z(), 200, 100);
  expect_near(rays.at(100, 0).ray.direction, normalize(Vec3{0, 0.5f, -1}));
  expect_near(rays.at(200, 50).ray.direction, normalize(Vec3{1, 0, -1}));
}

TEST(CameraRays, APixelIsAsWideAsItsNeighbourIsFar) {
  const CameraRays rays(looking_down_z(), 200, 100);
  const CameraRay a = rays.at(100, 50), b = rays.at(101, 50);
  EXPECT_NEAR(length(a.ray.direction - b.ray.direction), a.spread, 1e-5f);
  EXPECT_EQ(a.width, 0);
}

TEST(CameraRays, OrthographicRaysAreParallelAndMetresApart) {
  Camera camera = looking_down_z();
  camera.ortho_height = 4.0f;
  const CameraRays rays(camera, 200, 100);
  expect_near(rays.at(100, 0).ray.origin, {0, 2, 5});
  expect_near(rays.at(0, 100).ray.origin, {-4, -2, 5});
  expect_near(rays.at(0, 100).ray.direction, {0, 0, -1});
  EXPECT_NEAR(rays.at(0, 0).width, 0.04f, 1e-6f);
}

TEST(CameraRays, UpAlongTheViewIsNoTrouble) {
  Camera camera;
  camera.position = {0, 5, 0};
  camera.look_at = {0, 0, 0};
  const CameraRay ray = CameraRays(camera, 10, 10).at(0, 0);
  EXPECT_TRUE(is_finite(ray.ray.direction));
  EXPECT_LT(ray.ray.direction.y, -0.5f);
}

}  // namespace
}  // namespace penumbra
