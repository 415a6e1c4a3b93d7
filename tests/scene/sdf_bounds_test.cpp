#include <gtest/gtest.h>

#include "json_support.h"

namespace penumbra::test {
namespace {

Bounds bounds_of_root(const std::string& root) {
  return bounds_of(
      read_text(with_object(R"({"type": "sdf", "material": "floor", "root": )" + root + "}"))
          .sdfs.front());
}

void expect_box(const std::string& root, const Vec3& lo, const Vec3& hi) {
  const Bounds box = bounds_of_root(root);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(box.lo[i], lo[i], 1e-5) << root;
    EXPECT_NEAR(box.hi[i], hi[i], 1e-5) << root;
  }
}

const std::string ball = R"({"shape": "sphere", "center": [1, 0, 0], "radius": 0.5})";

TEST(SdfBounds, Shapes) {
  expect_box(ball, {0.5f, -0.5f, -0.5f}, {1.5f, 0.5f, 0.5f});
  expect_box(R"({"shape": "torus", "major_radius": 2, "minor_radius": 0.5})", {-2.5f, -0.5f, -2.5f},
             {2.5f, 0.5f, 2.5f});
  expect_box(R"({"shape": "cone", "angle_deg": 45, "height": 2})", {-2, -2, -2}, {2, 0, 2});
}

TEST(SdfBounds, Transforms) {
  expect_box(R"({"op": "rotate", "rotate_deg": [0, 0, 90], "child": )" + ball + "}",
             {-0.5f, 0.5f, -0.5f}, {0.5f, 1.5f, 0.5f});
  expect_box(R"({"op": "scale", "factor": [-2, 1, 1], "child": )" + ball + "}", {-3, -0.5f, -0.5f},
             {-1, 0.5f, 0.5f});
  expect_box(R"({"op": "mirror", "axes": "x", "child": )" + ball + "}", {-1.5f, -0.5f, -0.5f},
             {1.5f, 0.5f, 0.5f});
  expect_box(R"({"op": "repeat", "spacing": [2, 0, 0], "limit": [3, 0, 0], "child": )" + ball + "}",
             {-5.5f, -0.5f, -0.5f}, {7.5f, 0.5f, 0.5f});
  expect_box(R"({"op": "onion", "thickness": 0.1, "child": )" + ball + "}", {0.4f, -0.6f, -0.6f},
             {1.6f, 0.6f, 0.6f});
}

TEST(SdfBounds, UnboundedAndEmpty) {
  EXPECT_FALSE(is_finite(bounds_of_root(R"({"shape": "plane", "normal": [1, 1, 0]})")));
  EXPECT_FALSE(is_finite(
      bounds_of_root(R"({"op": "repeat", "spacing": [2, 0, 0], "child": )" + ball + "}")));
  EXPECT_TRUE(bounds_of_root(R"({"op": "intersection", "children": [)" + ball +
                             R"(, {"shape": "sphere", "center": [-1, 0, 0], "radius": 0.5}]})")
                  .empty());
}

TEST(SdfBounds, SmoothUnionReachesOut) {
  const Bounds box = bounds_of_root(R"({"op": "smooth_union", "k": 0.4, "children": [)" + ball +
                                    "," + ball + "]}");
  EXPECT_NEAR(box.hi.x, 1.6f, 1e-5);
}

}  // namespace
}  // namespace penumbra::test
