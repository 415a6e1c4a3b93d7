#include <gtest/gtest.h>

#include "shadow/shadows.h"

namespace penumbra {
namespace {

TEST(Receiver, IsOnTheSmoothSurfaceWhereThereIsOne) {
  Surface surface;
  surface.position = {1, 0, 0}, surface.smooth_position = {1, 0.1f, 0};
  surface.normal = {0, 1, 0}, surface.shading_normal = normalize(Vec3{0.1f, 1, 0});
  EXPECT_EQ(receiver_of(surface).position, surface.position);
  EXPECT_EQ(receiver_of(surface).normal, surface.normal);
  surface.smooth = true;
  EXPECT_EQ(receiver_of(surface).position, surface.smooth_position);
  EXPECT_EQ(receiver_of(surface).normal, surface.shading_normal);
}

}  // namespace
}  // namespace penumbra
