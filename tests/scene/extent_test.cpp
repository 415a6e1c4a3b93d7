#include "scene/extent.h"

#include <gtest/gtest.h>

#include "scene/finish.h"
#include "scene/json/builder.h"
#include "scene/sdf_path.h"

namespace penumbra {
namespace {

Scene scene_of(const std::string& root, const std::string& more = "") {
  return json::read_scene(json::Document(
      "s.json",
      R"({"materials": {"a": {}}, "objects": [{"type": "sdf", "material": "a", "root": )" + root +
          "}]" + more + "}"));
}

const char* const ball = R"({"shape": "sphere", "center": [1, 2, 3], "radius": 1})";
const std::string ball_on_plane =
    R"({"op": "union", "children": [)" + std::string(ball) + R"(, {"op": "round", "radius": 0.1,
       "child": {"shape": "plane", "normal": [0, 1, 0]}}]})";

TEST(Extent, OfWhatHasAnEndIsItsBox) {
  const Scene scene = scene_of(ball);
  EXPECT_TRUE(is_bounded(scene));
  EXPECT_NEAR(extent_of(scene).lo.x, 0, 1e-5);
  EXPECT_NEAR(extent_of(scene).hi.z, 4, 1e-5);
  EXPECT_FALSE(unbounded_node(scene.sdfs[0]).has_value());
}

TEST(Extent, MarchesToASunEndByWhatHasAnEnd) {
  EXPECT_NEAR(sun_bounds(scene_of(ball_on_plane)).lo.x, 0, 1e-5);
  EXPECT_NEAR(sun_bounds(scene_of(ball_on_plane)).hi.z, 4, 1e-5);
  EXPECT_EQ(sun_bounds(scene_of(R"({"shape": "plane", "normal": [0, 1, 0]})")).hi, Vec3(4));
}

TEST(Extent, OfTheRestIsWhatCamerasLookAt) {
  const Scene scene =
      scene_of(ball_on_plane, R"(, "camera": {"position": [0, 0, 9], "look_at": [0, 0, 0]})");
  EXPECT_FALSE(is_bounded(scene));
  EXPECT_EQ(extent_of(scene).lo, Vec3(-9));
  EXPECT_EQ(extent_of(scene).hi, Vec3(9));
  EXPECT_EQ(extent_of(scene_of(R"({"shape": "plane", "normal": [0, 1, 0]})")).hi, Vec3(4));
}

TEST(Extent, TheNodeWithoutEndIsFound) {
  const Scene scene = scene_of(ball_on_plane);
  const auto node = unbounded_node(scene.sdfs[0]);
  ASSERT_TRUE(node.has_value());
  EXPECT_EQ(sdf_path(scene.sdfs[0], *node), "root.children[1].child");
  const Scene repeated =
      scene_of(R"({"op": "onion", "thickness": 0.1, "child": {"op": "repeat", "spacing": [4, 0, 0],
                   "child": )" +
               std::string(ball) + "}}");
  EXPECT_EQ(sdf_path(repeated.sdfs[0], unbounded_node(repeated.sdfs[0]).value()), "root.child");
}

TEST(Extent, WhatHasNoEndGetsACamera) {
  Scene finite = scene_of(ball), partly = scene_of(ball_on_plane),
        endless = scene_of(R"({"shape": "plane", "normal": [0, 1, 0]})");
  for (Scene* scene : {&finite, &partly, &endless}) {
    add_missing_camera_and_light(*scene);
    ASSERT_EQ(scene->cameras.size(), 1u);
    ASSERT_EQ(scene->lights.size(), 1u);
    EXPECT_TRUE(is_finite(scene->cameras[0].position));
    EXPECT_EQ(scene->report.conversions.size(), 2u);
  }
  EXPECT_EQ(partly.cameras[0].position, finite.cameras[0].position);
  EXPECT_NE(partly.report.conversions[0].find("has no end"), std::string::npos);
  EXPECT_EQ(endless.cameras[0].position, default_view().position);
  EXPECT_EQ(endless.lights[0].type, LightType::sun);
  // The framed ball fills the picture's height but for the margin.
  const Camera& camera = finite.cameras[0];
  const float away = length(camera.position - Vec3(1, 2, 3));
  EXPECT_GT(std::atan(1 / away), 0.25f * camera.vertical_fov);
}

}  // namespace
}  // namespace penumbra
