#include <gtest/gtest.h>

#include "json_support.h"
#include "scene/json/builder.h"
#include "scene/turntable.h"

namespace penumbra::test {
namespace {

Scene at(double time, const std::string& text) {
  return json::read_scene(json::Document(scratch().file("s.json"), text), time);
}

std::string with_lamp(const std::string& keyframes, const std::string& more = {}) {
  return R"({"objects": [], "lights": [{"type": "sphere", "position": [0, 0, 0], "radius": 1,
"radiance": [1, 1, 1], "keyframes": )" +
         keyframes + more + "}]}";
}

TEST(Keyframes, MoveInStraightLines) {
  const std::string text = with_lamp(
      R"([{"time": 1, "position": [0, 2, 0]}, {"time": 3, "radius": 4}, {"time": 5, "position": [8, 2, -4], "radius": 2}])");
  const auto light = [&](double time) { return at(time, text).lights[0]; };
  EXPECT_EQ(light(0).position, Vec3(0, 2, 0));
  EXPECT_EQ(light(0).radius, 4);
  EXPECT_EQ(light(2).position, Vec3(2, 2, -1));
  EXPECT_EQ(light(2).radius, 4);
  EXPECT_EQ(light(4).position, Vec3(6, 2, -3));
  EXPECT_EQ(light(4).radius, 3);
  EXPECT_EQ(light(9).position, Vec3(8, 2, -4));
  EXPECT_EQ(at(0, text).keyframe_times, (std::vector<double>{1, 3, 5}));
}

TEST(Keyframes, SmoothStartsAndEndsAtRest) {
  const std::string text = with_lamp(R"([{"time": 0, "radius": 1}, {"time": 4, "radius": 3}])",
                                     R"(, "interpolation": "smooth")");
  for (const double s : {0.0, 0.25, 0.5, 0.9, 1.0})
    EXPECT_NEAR(at(4 * s, text).lights[0].radius, 1 + 2 * s * s * (3 - 2 * s), 1e-6) << s;
}

TEST(Keyframes, SmoothNeverOvershootsAndHasNoCorner) {
  const std::string text = with_lamp(
      R"([{"time": 0, "radius": 1}, {"time": 1, "radius": 2}, {"time": 1.5, "radius": 4}, {"time": 4, "radius": 4}, {"time": 5, "radius": 0.5}])",
      R"(, "interpolation": "smooth")");
  const auto radius = [&](double time) { return double(at(time, text).lights[0].radius); };
  double before = radius(0);
  for (double t = 0.05; t < 1.5; t += 0.05) {
    EXPECT_GE(radius(t), before - 1e-6) << t;
    before = radius(t);
  }
  for (double t = 1.5; t <= 4; t += 0.1) EXPECT_NEAR(radius(t), 4, 1e-5) << t;
  for (double t = 4; t <= 5; t += 0.1) EXPECT_GE(radius(t), 0.5) << t;
  const double step = 1e-2;
  for (const double key : {1.0, 1.5, 4.0})
    EXPECT_NEAR(radius(key + step) - radius(key), radius(key) - radius(key - step), 0.005) << key;
}

TEST(Keyframes, MoveCamerasTransformsAndNodes) {
  const Scene scene = at(0.5, R"({
    "camera": {"position": [0, 0, 4], "look_at": [0, 0, 0], "vertical_fov_deg": 40,
               "keyframes": [{"time": 0, "vertical_fov_deg": 20}, {"time": 1, "vertical_fov_deg": 40}]},
    "materials": {"a": {}},
    "objects": [
      {"type": "sdf", "material": "a", "root": {"op": "union", "children": [
        {"op": "translate", "offset": [0, 0, 0], "child": {"shape": "sphere", "radius": 1,
           "keyframes": [{"time": 0, "radius": 1}, {"time": 1, "radius": 2}]},
         "keyframes": [{"time": 0, "offset": [0, 0, 0]}, {"time": 1, "offset": [0, 4, 0]}]}]}},
      {"type": "quad", "corner": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [0, 1, 0], "material": "a",
       "keyframes": [{"time": 0.5, "corner": [5, 0, 0]}]}]})");
  EXPECT_FLOAT_EQ(scene.cameras[0].vertical_fov, 30 * std::acos(-1.0f) / 180);
  const SdfTree& tree = scene.sdfs[0];
  EXPECT_EQ(tree.numbers_of(tree.nodes[1])[1], 2);
  bool found = false;
  for (const SdfNode& node : tree.nodes)
    if (node.op == SdfOp::sphere) {
      const auto numbers = tree.numbers_of(node);
      found = std::ranges::find(numbers, 1.5f) != numbers.end();
    }
  EXPECT_TRUE(found);
  EXPECT_EQ(scene.meshes[0].positions[0], Vec3(5, 0, 0));
}

TEST(Keyframes, StillScenesHaveNone) {
  EXPECT_TRUE(at(3, R"({"objects": []})").keyframe_times.empty());
}

struct Refused {
  std::string text, message;
};

TEST(Keyframes, MistakesAreNamedWithTheirPlace) {
  const Refused cases[] = {
      {with_lamp("{}"), R"(s.json:2:37: "keyframes" is an object; give an array [ ])"},
      {with_lamp("[]"),
       "s.json:2:37: the keyframes of the light are none; give at least one, or leave "
       "\"keyframes\" out"},
      {with_lamp("[3]"), "s.json:2:38: a keyframe is a number; give an object { } with a \"time\""},
      {with_lamp(R"([{"radius": 3}])"),
       "s.json:2:38: missing key \"time\" in a keyframe; add it, in seconds"},
      {with_lamp(R"([{"time": "now"}])"),
       R"(s.json:2:47: "time" is a string; give seconds, at most 1e9)"},
      {with_lamp(R"([{"time": 2}, {"time": 1}])"),
       "s.json:2:60: the keyframe at 1 s follows one at 2 s; put keyframes in the order of their "
       "times, each once"},
      {with_lamp(R"([{"time": 0, "raduis": 1}])"),
       R"(s.json:2:50: a keyframe moves "raduis", which the light does not have; give it there too, or correct the name)"},
      {with_lamp(R"([{"time": 0, "type": "disk"}])"),
       R"(s.json:2:58: "type" of a keyframe cannot move: it is a string; move numbers, and arrays and objects of numbers)"},
      {with_lamp(R"([{"time": 0, "position": [1, 2]}])"),
       R"(s.json:2:62: "position" of a keyframe has 2 entries; give 3 entries, as the key itself has)"},
      {with_lamp(R"([{"time": 0, "position": 1}])"),
       R"(s.json:2:62: "position" of a keyframe is a number; give 3 entries, as the key itself has)"},
      {with_lamp(R"([{"time": 0, "radius": -1}])"),
       R"(s.json:2:60: "radius" is -1; give a length above 0)"},
      {with_lamp(R"([{"time": 0}])", R"(, "interpolation": "smoth")"),
       R"(s.json:2:69: unknown interpolation "smoth"; did you mean "smooth"? (known: linear, smooth))"}};
  for (const Refused& c : cases) {
    const std::string message = error_of(c.text);
    EXPECT_EQ(message.substr(0, c.message.find("give a length")),
              c.message.substr(0, c.message.find("give a length")));
  }
  EXPECT_EQ(
      error_of(
          R"({"objects": [], "camera": {"position": [0, 0, 1], "look_at": [0, 0, 0], "interpolation": "linear"}})"),
      "s.json:1:90: the camera has an \"interpolation\" and no keyframes; give \"keyframes\" or "
      "leave it out");
}

TEST(Turntable, GoesRoundAndComesBack) {
  Camera camera;
  camera.position = {3, 2, 1}, camera.look_at = {0, 1, 0};
  const Bounds box{{-1, 0, -1}, {1, 2, 1}};
  const double whole = 2 * std::acos(-1.0);
  for (int i = 0; i <= 8; ++i) {
    const Camera c = turned_about_scene(camera, box, whole * i / 8);
    EXPECT_NEAR(length(c.position - Vec3(0, 2, 0)), length(camera.position - Vec3(0, 2, 0)), 0.1);
    EXPECT_FLOAT_EQ(c.position.y, 2);
    EXPECT_NEAR(length(c.look_at - c.position), length(camera.look_at - camera.position), 1e-5);
  }
  Camera south;
  south.position = {0, 1, 5}, south.look_at = {0, 1, 0};
  const Camera east = turned_about_scene(south, box, whole / 4);
  EXPECT_LT(length(east.position - Vec3(5, 1, 0)), 1e-5f);  // counterclockwise from above
  const Camera quarter = turned_about_scene(camera, box, whole / 4);
  EXPECT_LT(dot(normalize(quarter.position - quarter.look_at),
                normalize(camera.position - camera.look_at)),
            0.2f);
  EXPECT_LT(length(turned_about_scene(camera, box, whole).position - camera.position), 1e-5f);
}

}  // namespace
}  // namespace penumbra::test
