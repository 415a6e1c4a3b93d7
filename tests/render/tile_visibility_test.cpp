#include "render/tile_visibility.h"

#include <gtest/gtest.h>

namespace penumbra {
namespace {

ShadingPoint glazed() {
  ShadingPoint point;
  point.normal = {0, 1, 0};
  point.to_viewer = normalize(Vec3{-1, 1, 0});
  point.specular = Vec3(0.04f);
  point.alpha = 0.1f;
  return point;
}

const LightPoint mirrored{normalize(Vec3{1, 1, 0}), 0.1f, true};
const LightPoint overhead{{0, 1, 0}, 0.1f, true};

TEST(ArrivalFrom, IsOneWhereEverythingIsSeenAndZeroWhereNothingIs) {
  std::vector<LightPoint> points{mirrored, overhead};
  EXPECT_EQ(arrival_from(points, glazed()).diffuse, 1);
  EXPECT_EQ(arrival_from(points, glazed()).glossy, 1);
  for (LightPoint& p : points) p.visible = false;
  EXPECT_EQ(arrival_from(points, glazed()).diffuse, 0);
  EXPECT_EQ(arrival_from(points, glazed()).glossy, 0);
  EXPECT_EQ(arrival_from({}, glazed()).diffuse, 0);
}

TEST(ArrivalFrom, WeighsByCosineAndLobe) {
  std::vector<LightPoint> points{mirrored, overhead};
  points[1].visible = false;
  const LightArrival arrival = arrival_from(points, glazed());
  const float c = std::sqrt(0.5f);
  EXPECT_NEAR(arrival.diffuse, c / (1 + c), 1e-5f);
  EXPECT_GT(arrival.glossy, 0.95f) << "the highlight is seen";
}

TEST(ArrivalFrom, PointsBelowTheHorizonCountForNothing) {
  const std::vector<LightPoint> points{overhead, {{0, -1, 0}, 5, false}};
  EXPECT_EQ(arrival_from(points, glazed()).diffuse, 1);
}

}  // namespace
}  // namespace penumbra
