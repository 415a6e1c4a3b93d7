// Distance-field objects: what the reader makes of them, and every wrong one's message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "json_support.h"
#include "scene/finish.h"
#include "scene/info.h"

namespace penumbra::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string sdf(const std::string& root) {
  return with_object(R"({"type": "sdf", "material": "floor", "root":)"
                     "\n" +
                     root + "}");
}

SdfTree tree_of(const std::string& root) {
  const Scene scene = read_text(sdf(root));
  EXPECT_EQ(scene.sdfs.size(), 1u);
  return scene.sdfs.front();
}

TEST(JsonSdf, ChildrenFollowTheirParent) {
  const SdfTree tree = tree_of(R"({"op": "union", "children": [
      {"op": "translate", "offset": [1, 2, 3], "child": {"shape": "sphere", "radius": 2}},
      {"shape": "box", "min": [0, 0, 0], "max": [1, 2, 4], "material": "metal"}]})");
  ASSERT_EQ(tree.nodes.size(), 4u);
  EXPECT_EQ(tree.nodes[0].op, SdfOp::union_);
  EXPECT_EQ(tree.nodes[0].first_child, 1u);
  EXPECT_EQ(tree.nodes[0].child_count, 2u);
  EXPECT_EQ(tree.nodes[1].first_child, 3u);
  EXPECT_THAT(tree.numbers_of(tree.nodes[1]), ElementsAre(1, 2, 3));
  EXPECT_THAT(tree.numbers_of(tree.nodes[2]), ElementsAre(0.5, 1, 2, 0.5, 1, 2));
  EXPECT_THAT(tree.numbers_of(tree.nodes[3]), ElementsAre(0, 0, 0, 2));
}

TEST(JsonSdf, MaterialsAreInherited) {
  const SdfTree tree = tree_of(R"({"op": "union", "children": [{"shape": "sphere", "radius": 1},
      {"op": "onion", "thickness": 0.1, "material": "metal", "child":
        {"op": "union", "children": [{"shape": "sphere", "radius": 1},
                                     {"shape": "sphere", "radius": 1, "material": "floor"}]}}]})");
  std::vector<std::uint32_t> materials;
  for (const SdfNode& node : tree.nodes) materials.push_back(node.material);
  EXPECT_THAT(materials, ElementsAre(0, 0, 1, 1, 1, 0));
}

TEST(JsonSdf, StoredNumbers) {
  const auto numbers = [](const std::string& root) { return tree_of(root).numbers; };
  EXPECT_THAT(numbers(R"({"shape": "plane", "normal": [0, 2, 0], "point": [5, 3, 5]})"),
              ElementsAre(0, 1, 0, 3));
  const std::string child = R"("child": {"shape": "sphere", "radius": 1}})";
  EXPECT_THAT(numbers(R"({"op": "mirror", "axes": "zx", )" + child),
              ElementsAre(1, 0, 1, 0, 0, 0, 1));
  EXPECT_THAT(numbers(R"({"op": "scale", "factor": 2, )" + child),
              ElementsAre(2, 2, 2, 0, 0, 0, 1));
  EXPECT_THAT(numbers(R"({"op": "repeat", "spacing": [1, 0, 2], )" + child),
              ElementsAre(1, 0, 2, -1, -1, -1, 0, 0, 0, 1));
  const SdfTree ring = tree_of(R"({"shape": "revolution", "offset": 2, "profile":
      {"shape": "polygon", "vertices": [[0, 0], [1, 0], [0, 1]]}})");
  EXPECT_EQ(ring.nodes[0].profile, SdfProfile::polygon);
  EXPECT_THAT(ring.profile_numbers(ring.nodes[0]), ElementsAre(0, 0, 1, 0, 0, 1));
  EXPECT_THAT(ring.parameter(ring.nodes[0], 1), ElementsAre(2));
}

std::string message_of(const std::string& root) {
  const std::string message = error_of(sdf(root));
  return message.starts_with("s.json:") ? message.substr(7) : message;
}

TEST(JsonSdf, WrongNodes) {
  EXPECT_THAT(
      message_of(R"({"shape": "spehre", "radius": 1})"),
      HasSubstr(R"(3:11: unknown shape "spehre" at root; did you mean "sphere"? (known: )"));
  EXPECT_THAT(message_of(R"({"op": "unoin", "children": []})"),
              HasSubstr(R"(unknown op "unoin" at root; did you mean "union"? (known: union, )"));
  EXPECT_EQ(message_of(R"({"op": "union", "children": [{"op": "onion", "thickness": 0.1, "child":
{"shape": "spere"}}]})")
                .substr(0, 80),
            R"(4:11: unknown shape "spere" at root.children[0].child; did you mean "sphere"? (k)");
  EXPECT_EQ(message_of(R"({"shape": "union", "children": []})"),
            R"(3:11: "union" at root is no shape; write "op": "union")");
  EXPECT_EQ(message_of(R"({"op": "sphere", "radius": 1})"),
            R"(3:8: "sphere" at root is no op; write "shape": "sphere")");
  EXPECT_EQ(
      message_of("{}"),
      R"(3:1: root has neither "shape" nor "op"; give a "shape", or an "op" with its children)");
  EXPECT_EQ(message_of("3"), "3:1: root is a number; give an object { }");
}

TEST(JsonSdf, WrongParameters) {
  EXPECT_EQ(message_of(R"({"shape": "sphere"})"),
            R"(3:1: missing key "radius" in the sphere at root; add it)");
  EXPECT_EQ(
      message_of(R"({"shape": "sphere", "radius": 1, "raduis": 2})"),
      R"(3:34: unknown key "raduis" in the sphere at root; did you mean "radius"? (known: shape, op, center, radius, material, keyframes, interpolation))");
  EXPECT_EQ(message_of(R"({"shape": "sphere", "radius": -1})"),
            R"(3:31: "radius" is -1 in the sphere at root; give a number above 0 (1e-12 to 1e9))");
  EXPECT_EQ(message_of(R"({"shape": "sphere", "radius": NaN})"),
            R"(3:31: not valid JSON: a value is expected; correct the text there)");
  EXPECT_EQ(
      message_of(R"({"shape": "box", "half_size": [1, 0, 1]})"),
      R"(3:35: "half_size"[1] is 0 in the box at root; give [x, y, z], each a number above 0 (1e-12 to 1e9))");
  EXPECT_EQ(
      message_of(R"({"shape": "box", "min": [0, 0, 0], "half_size": [1, 1, 1]})"),
      R"(3:49: both "half_size" and "min" are given in the box at root; give "min" and "max", or "center" and "half_size")");
  EXPECT_EQ(
      message_of(R"({"shape": "box", "min": [0, 0, 0], "max": [1, 0, 1]})"),
      R"(3:43: "max" does not lie above "min" along y in the box at root; give a "max" above "min" in x, y and z)");
  EXPECT_EQ(
      message_of(R"({"shape": "round_box", "half_size": [1, 0.1, 1], "radius": 0.2})"),
      R"(3:60: "radius" is 0.2, more than the least half_size, in the round_box at root; give a smaller radius)");
  EXPECT_EQ(message_of(R"({"shape": "capsule", "from": [1, 1, 1], "to": [1, 1, 1], "radius": 1})"),
            R"(3:47: "from" and "to" are the same point in the capsule at root; use a sphere)");
  EXPECT_EQ(message_of(R"({"shape": "plane", "normal": [0, 0, 0]})"),
            R"(3:30: "normal" has no length in the plane at root; give a vector other than zero)");
  EXPECT_EQ(
      message_of(R"({"shape": "plane", "normal": [0, 1, 0], "point": [0, 0, 0], "offset": 1})"),
      R"(3:71: both "point" and "offset" are given in the plane at root; give one of them)");
  EXPECT_EQ(
      message_of(R"({"shape": "cone", "angle_deg": 90, "height": 1})"),
      R"(3:32: "angle_deg" is 90 in the cone at root; give degrees above 0 and below 90 (0.001 to 89.999))");
  EXPECT_EQ(message_of(R"({"shape": "extrusion", "half_height": 1})"),
            R"(3:1: missing key "profile" in the extrusion at root; add it)");
  EXPECT_EQ(message_of(R"({"shape": "extrusion", "half_height": 1, "profile": {"shape": "polygon",
                           "vertices": [[0, 0], [2, 2], [2, 0], [0, 1]]}})"),
            "4:40: the polygon crosses or touches itself: edges 0 and 2 meet in "
            "the profile of the extrusion at root; order the vertices "
            "around its border");
}

TEST(JsonSdf, WrongOperators) {
  EXPECT_EQ(message_of(R"({"op": "union", "children": []})"),
            R"(3:29: the union at root has no children; give at least one)");
  EXPECT_EQ(message_of(R"({"op": "union"})"),
            R"(3:1: missing key "children" in the union at root; add it)");
  EXPECT_EQ(
      message_of(
          R"({"op": "smooth_union", "k": -0.1, "children": [{"shape": "sphere", "radius": 1}]})"),
      R"(3:29: "k" is -0.1 in the smooth_union at root; give a number from 0 to 1e9)");
  const std::string child = R"("child": {"shape": "sphere", "radius": 1}})";
  EXPECT_EQ(
      message_of(R"({"op": "scale", "factor": 0, )" + child),
      R"(3:27: "factor" is 0 in the scale at root; give a number other than 0, or [x, y, z] of such)");
  EXPECT_EQ(
      message_of(R"({"op": "mirror", "axes": "xw", )" + child),
      R"(3:26: "axes" is "xw" in the mirror at root; give axes, each once: "x", "yz", "xyz" …)");
  EXPECT_EQ(message_of(R"({"op": "repeat", "spacing": [1, 1, 1], "limit": [1, 2.5, 3], )" + child),
            R"(3:49: "limit"[1] is 2.5 in the repeat at root; give whole numbers)");
  EXPECT_EQ(
      message_of(R"({"op": "onion", "thickness": 0.1, "children": [], )" + child),
      R"(3:47: both "child" and "children" are given in the onion at root; give one of them)");
}

TEST(JsonSdf, AThousandLevelsDeep) {
  std::string root = R"({"shape": "sphere", "radius": 1})";
  for (int i = 0; i < 1000; ++i) root = R"({"op": "union", "children": [)" + root + "]}";
  EXPECT_EQ(tree_of(root).nodes.size(), 1001u);
  root.replace(root.find("radius"), 6, "rodius");
  EXPECT_THAT(message_of(root), HasSubstr("in the sphere at root...(992 more).children[0]"));
}

TEST(JsonSdf, AHundredThousandNodes) {
  std::string root = R"({"op": "union", "children": [)";
  for (int i = 0; i < 100000; ++i)
    root.append(i ? "," : "")
        .append(R"({"shape": "sphere", "center": [)")
        .append(std::to_string(i)) += R"(, 0, 0], "radius": 0.5})";
  const SdfTree tree = tree_of(root + "]}");
  EXPECT_EQ(tree.nodes.size(), 100001u);
  const Bounds box = bounds_of(tree);
  EXPECT_NEAR(box.hi.x, 99999.5f, 0.02f);
}

TEST(JsonSdf, ObjectsOfTheOldTypesKeepTheirShape) {
  const Scene scene = read_text(R"({"materials": {"m": {}}, "objects": [
      {"type": "quad", "corner": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [0, 2, 0], "material": "m"},
      {"type": "box", "min": [0, 0, 0], "max": [1, 2, 3], "material": "m"},
      {"type": "polygon", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "material": "m"}]})");
  EXPECT_EQ(std::get<ExactQuad>(scene.meshes[0].exact).edge_v, Vec3(0, 2, 0));
  EXPECT_EQ(std::get<ExactBox>(scene.meshes[1].exact).hi, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<ExactPolygon>(scene.meshes[2].exact).vertices.size(), 3u);
}

TEST(JsonSdf, TexturesAndEmissionWarn) {
  const Scene scene = read_text(R"({"materials": {"lamp": {"emission": [1, 1, 1]}}, "objects": [
      {"type": "sdf", "name": "orb", "material": "lamp", "root": {"shape": "sphere", "radius": 1}}]})");
  EXPECT_THAT(scene.report.warnings,
              ElementsAre("the distance field \"orb\" glows by material \"lamp\" without lighting "
                          "the scene"));
}

TEST(JsonSdf, Info) {
  Scene scene = read_text(sdf(R"({"op": "union", "children": [{"shape": "sphere", "radius": 1},
      {"shape": "sphere", "radius": 2}]})"));
  finish_scene(scene, "s.json");
  EXPECT_THAT(describe(scene),
              HasSubstr("fields      1\n   0        \"sdf 0\"  3 nodes, 2 levels: 2 "
                        "sphere, 1 union; within (-2, -2, -2) to (2, 2, 2)\n"));
}

TEST(JsonSdf, GlslObjects) {
  write_file(scratch().file("m.glsl"), "float map(vec3 p) { return p.y; }");
  const Scene scene = read_text(with_object(R"({"type": "glsl", "file": "m.glsl"})"));
  EXPECT_EQ(scene.glsl->text, "float map(vec3 p) { return p.y; }");
  EXPECT_EQ(error_of(with_object(R"({"type": "glsl", "file": "n.glsl"})")),
            "s.json:2:26: there is no shader file \"n.glsl\"; name one relative to the scene file");
  EXPECT_EQ(error_of(with_object(R"({"type": "glsl", "file": "m.glsl"},
{"type": "glsl", "file": "m.glsl"})")),
            "s.json:3:10: a scene holds one \"glsl\" object, and this is the second; join their "
            "map() functions in one file");
}

}  // namespace
}  // namespace penumbra::test
