// Every wrong scene and its exact message.
#include <gtest/gtest.h>

#include "json_support.h"

namespace penumbra::test {
namespace {

struct Case {
  const char* text;
  const char* message;  // after "s.json:"
};

using Wrap = std::string (*)(const std::string&);
std::string as_it_is(const std::string& text) { return text; }

void expect_messages(Wrap wrap, std::initializer_list<Case> cases) {
  for (const Case& c : cases)
    EXPECT_EQ(error_of(wrap(c.text)), std::string("s.json:").append(c.message)) << c.text;
}

TEST(JsonMisuse, Text) {
  expect_messages(
      as_it_is,
      {
          {R"()",
           R"(1:1: not valid JSON: a value is expected, but the text ends; correct the text there)"},
          {R"({)",
           R"(1:2: not valid JSON: a key in quotes or '}' is expected, but the text ends; correct the text there)"},
          {R"("x")", R"(1:1: not valid JSON: '{' is expected; correct the text there)"},
          {R"([1, 2])", R"(1:1: the scene is an array; give an object { })"},
          {R"({"objects": [})",
           R"(1:14: not valid JSON: a value is expected; correct the text there)"},
          {R"({"objects": [],})",
           R"(1:16: not valid JSON: a key in quotes or '}' is expected; correct the text there)"},
          {R"({"objects": [1,]})",
           R"(1:16: not valid JSON: a value is expected; correct the text there)"},
          {R"({"objects" []})", R"(1:12: not valid JSON: ':' is expected; correct the text there)"},
          {R"({"objects": []} more)",
           R"(1:17: not valid JSON: something follows the end of the scene; correct the text there)"},
          {R"({"objects": [], "objects": []})",
           R"(1:17: duplicate key "objects"; keep one of the two)"},
          {R"({"objects": [], "ambient": [1e999, 0, 0]})",
           R"(1:29: not valid JSON: '1e999' is not a number; correct the text there)"},
          {R"({"objects": [], "ambient": [NaN, 0, 0]})",
           R"(1:29: not valid JSON: a value is expected; correct the text there)"},
          {R"({"objects": [], "ambient": [+1, 0, 0]})",
           R"(1:29: "ambient"[0] is "+1", which is no JSON number; give [r, g, b], three numbers from 0 to 1e12)"},
          {R"({"objects": [], "ambient": [-, 0, 0]})",
           R"(1:29: "ambient"[0] is "-", which is no JSON number; give [r, g, b], three numbers from 0 to 1e12)"},
          {R"({"objects": [], "ambient": [01, 0, 0]})",
           R"(1:29: "ambient"[0] is "01", which is no JSON number; give [r, g, b], three numbers from 0 to 1e12)"},
          {R"({"objects": [], "ambient": [1., 0, 0]})",
           R"(1:29: "ambient"[0] is "1.", which is no JSON number; give [r, g, b], three numbers from 0 to 1e12)"},
          {R"({} /* never)", R"(1:4: the comment has no end; close it with */)"},
      });
}

TEST(JsonMisuse, Places) {
  expect_messages(
      as_it_is,
      {
          {"{\n  \"objects\": [],\n  \"ambient\": [0.1, 0.1 0.1]\n}",
           R"(3:24: not valid JSON: ',' or ']' is expected; correct the text there)"},
          {"{\r\n  \"objects\": 3\r\n}", R"(2:14: "objects" is a number; give an array [ ])"},
          {R"({/* äöü */ "objects": 3})", R"(1:23: "objects" is a number; give an array [ ])"},
          {"\xEF\xBB\xBF{\"objects\": 3}", R"(1:13: "objects" is a number; give an array [ ])"},
          {R"({"objects": [], /* "ambien": */ "ambien" /* : */ : [0, 0, 0]})",
           R"(1:33: unknown key "ambien" in the scene; did you mean "ambient"? (known: $schema, camera, cameras, materials, objects, lights, ambient, background))"},
          {"// \"objects\": {\n{\"objects\": 3}",
           R"(2:13: "objects" is a number; give an array [ ])"},
          {R"({"objects": [], /* " */ "ambien": [0, 0, 0]})",
           R"(1:25: unknown key "ambien" in the scene; did you mean "ambient"? (known: $schema, camera, cameras, materials, objects, lights, ambient, background))"},
      });
}

TEST(JsonMisuse, Sections) {
  expect_messages(
      as_it_is,
      {
          {R"({})", R"(1:1: missing key "objects" in the scene; add it)"},
          {R"({"objects": {}})", R"(1:13: "objects" is an object; give an array [ ])"},
          {R"({"objects": [7]})", R"(1:14: an object is a number; give an object { })"},
          {R"({"objects": [], "lights": 5})", R"(1:27: "lights" is a number; give an array [ ])"},
          {R"({"objects": [], "materials": []})",
           R"(1:30: "materials" is an array; give an object { })"},
          {R"({"objects": [], "ambient": 0.5})",
           R"(1:28: "ambient" is a number; give [r, g, b], three numbers from 0 to 1e12)"},
          {R"({"objects": [], "background": [0, -1, 0]})",
           R"(1:35: "background"[1] is -1; give [r, g, b], three numbers from 0 to 1e12)"},
          {R"({"objects": [], "camera": {}, "cameras": {}})",
           R"(1:42: both "camera" and "cameras" are given; put every camera under "cameras")"},
          {R"({"objects": [], "$schema": 1})", R"(1:28: "$schema" is a number; give a string)"},
      });
}

TEST(JsonMisuse, Cameras) {
  expect_messages(
      with_camera,
      {
          {R"({"position": [0, 0, 1]})", R"(2:1: missing key "look_at" in a camera; add it)"},
          {R"({"position": [0, 0, 1], "look_at": [0, 0, 1]})",
           R"(2:36: the camera looks at its own position; move "look_at" or "position")"},
          {R"({"position": [0, 0, 1], "look_at": [0, 0, 0], "up": [0, 0, 2]})",
           R"(2:53: "up" of the camera points along its view; give an "up" across the view, such as [0, 0, 1])"},
          {R"({"position": [0, 0, 1], "look_at": [0, 0, 0], "up": [0, 0, 0]})",
           R"(2:53: "up" has no length; give a vector other than zero)"},
          {R"({"position": [0, 0, 1], "look_at": [0, 0, 0], "vertical_fov_deg": 0})",
           R"(2:67: "vertical_fov_deg" is 0; give degrees above 0 and below 180 (0.001 to 179.999))"},
          {R"({"position": [0, 0, 1], "look_at": [0, 0, 0], "vertical_fov_deg": 180})",
           R"(2:67: "vertical_fov_deg" is 180; give degrees above 0 and below 180 (0.001 to 179.999))"},
          {R"({"position": [0, 0, 1], "look_at": [0, 0, 0], "vertical_fov": 40})",
           R"(2:47: unknown key "vertical_fov" in a camera; did you mean "vertical_fov_deg"? (known: position, look_at, up, vertical_fov_deg, keyframes, interpolation))"},
          {R"({"position": [0, 0, 1], "look_at": [0, 0]})",
           R"(2:36: "look_at" has 2 entries instead of 3; give [x, y, z], three numbers of size at most 1e9)"},
          {R"([0, 0, 1])", R"(2:1: a camera is an array; give an object { })"},
      });
}

TEST(JsonMisuse, Materials) {
  expect_messages(
      with_material,
      {
          {R"({"diffuse": [1, 1, 1.5]})",
           R"(2:20: "diffuse"[2] is 1.5; give [r, g, b], three numbers from 0 to 1)"},
          {R"({"diffuse": "red"})",
           R"(2:13: "diffuse" is a string; give [r, g, b], three numbers from 0 to 1)"},
          {R"({"specular": 0.5})",
           R"(2:14: "specular" is a number; give [r, g, b], three numbers from 0 to 1)"},
          {R"({"mirror": 1.2})",
           R"(2:12: "mirror" is 1.2; give a number from 0 to 1, or [r, g, b] of such)"},
          {R"({"mirror": [0, 0, true]})",
           R"(2:19: "mirror"[2] is a boolean; give a number from 0 to 1, or [r, g, b] of such)"},
          {R"({"roughness": null})", R"(2:15: "roughness" is null; give a number from 0 to 1)"},
          {R"({"roughness": -0.1})", R"(2:15: "roughness" is -0.1; give a number from 0 to 1)"},
          {R"({"emission": [-1, 0, 0]})",
           R"(2:15: "emission"[0] is -1; give [r, g, b], three numbers from 0 to 1e12)"},
          {R"({"texture": "missing.png"})",
           R"(2:13: there is no image file "missing.png"; name a PNG or JPEG file, relative to the scene file)"},
          {R"({"texture": ""})", R"(2:13: "texture" is empty; give a file name)"},
          {R"({"texture": "a\u0000b"})",
           R"(2:13: "texture" holds a control character; give plain text)"},
          {R"({"difuse": [1, 1, 1]})",
           R"(2:2: unknown key "difuse" in a material; did you mean "diffuse"? (known: diffuse, specular, roughness, mirror, emission, texture, emission_texture))"},
      });
}

TEST(JsonMisuse, Objects) {
  expect_messages(
      with_object,
      {
          {R"({"type": "spher", "radius": 1})",
           R"(2:10: unknown object type "spher"; did you mean "sphere"? (known: quad, sphere, box, polygon, mesh, sdf, glsl))"},
          {R"({"center": [0, 0, 0]})",
           R"(2:1: missing key "type" in an object; add one of quad, sphere, box, polygon, mesh, sdf, glsl)"},
          {R"({"type": 3})", R"(2:10: "type" is a number; give a string)"},
          {R"({"type": "sphere", "name": 4, "center": [0, 0, 0], "radius": 1, "material": "floor"})",
           R"(2:28: "name" is a number; give a string)"},
      });
}

TEST(JsonMisuse, Spheres) {
  expect_messages(
      with_object,
      {
          {R"({"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "flor"})",
           R"(2:66: unknown material "flor"; did you mean "floor"?)"},
          {R"({"type": "sphere", "center": [0, 0, 0], "raduis": 1, "material": "floor"})",
           R"(2:41: unknown key "raduis" in a sphere object; did you mean "radius"? (known: type, name, receives, samples_scale, keyframes, interpolation, center, radius, material))"},
          {R"({"type": "sphere", "center": [0, 0, 0], "material": "floor"})",
           R"(2:1: missing key "radius" in a sphere object; add it)"},
          {R"({"type": "sphere", "center": [0, 0, 0], "radius": 1})",
           R"(2:1: missing key "material" in a sphere object; add it)"},
          {R"({"type": "sphere", "center": [0, 0, 0], "radius": -1, "material": "floor"})",
           R"(2:51: "radius" is -1; give a number above 0 (1e-12 to 1e9))"},
          {R"({"type": "sphere", "center": [0, 0, 0], "radius": 0, "material": "floor"})",
           R"(2:51: "radius" is 0; give a number above 0 (1e-12 to 1e9))"},
          {R"({"type": "sphere", "center": [0, 0, 0], "radius": 1e300, "material": "floor"})",
           R"(2:51: "radius" is 1e+300; give a number above 0 (1e-12 to 1e9))"},
          {R"({"type": "sphere", "center": [0, 0, 0], "radius": "1", "material": "floor"})",
           R"(2:51: "radius" is a string; give a number above 0 (1e-12 to 1e9))"},
          {R"({"type": "sphere", "center": [0, "a", 0], "radius": 1, "material": "floor"})",
           R"(2:34: "center"[1] is a string; give [x, y, z], three numbers of size at most 1e9)"},
          {R"({"type": "sphere", "center": [0, 1e10, 0], "radius": 1, "material": "floor"})",
           R"(2:34: "center"[1] is 1e+10; give [x, y, z], three numbers of size at most 1e9)"},
          {R"({"type": "sphere", "center": [0, 0, 0, 0], "radius": 1, "material": "floor"})",
           R"(2:30: "center" has 4 entries instead of 3; give [x, y, z], three numbers of size at most 1e9)"},
          {R"({"type": "sphere", "receives": 1, "center": [0, 0, 0], "radius": 1, "material": "floor"})",
           R"(2:32: "receives" is a number; give true or false)"},
          {R"({"type": "sphere", "samples_scale": 0, "center": [0, 0, 0], "radius": 1, "material": "floor"})",
           R"(2:37: "samples_scale" is 0; give a number from 0.001 to 1000)"},
          {R"({"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "floor", "recieves": false})",
           R"(2:75: unknown key "recieves" in a sphere object; did you mean "receives"? (known: type, name, receives, samples_scale, keyframes, interpolation, center, radius, material))"},
      });
}

TEST(JsonMisuse, FlatShapes) {
  expect_messages(
      with_object,
      {
          {R"({"type": "quad", "corner": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [2, 0, 0], "material": "floor"})",
           R"(2:70: "edge_u" and "edge_v" are parallel; give edges that span an area)"},
          {R"({"type": "quad", "corner": [0, 0, 0], "edge_u": [0, 0, 0], "edge_v": [2, 0, 0], "material": "floor"})",
           R"(2:49: "edge_u" has no length; give a vector other than zero)"},
          {R"({"type": "box", "min": [0, 0, 0], "max": [1, 0, 1], "material": "floor"})",
           R"(2:42: "max" of the box does not lie above its "min" in y; give a "max" above "min" in x, y and z)"},
          {R"({"type": "polygon", "vertices": [[0, 0, 0], [1, 0, 0]], "material": "floor"})",
           R"(2:33: the polygon has 2 vertices; give 3 to 1000, or use a mesh file)"},
          {R"({"type": "polygon", "vertices": [[0, 0, 0], [1, 0, 0], [2, 0, 0]], "material": "floor"})",
           R"(2:33: the polygon has no area; give vertices that go around one)"},
          {R"({"type": "polygon", "vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.1]], "material": "floor"})",
           R"(2:33: the polygon is not planar: vertex 3 lies off its plane; move it into the plane or use several polygons)"},
          {R"({"type": "polygon", "vertices": [[0, 0, 0], [1, 1, 0], [1, 0, 0], [0, 2, 0]], "material": "floor"})",
           R"(2:33: the polygon crosses or touches itself: edges 0 and 2 meet; order the vertices around its border)"},
          {R"({"type": "polygon", "vertices": [[0, 0, 0], 5], "material": "floor"})",
           R"(2:45: "vertices" is a number; give [x, y, z], three numbers of size at most 1e9)"},
      });
}

TEST(JsonMisuse, Meshes) {
  expect_messages(
      with_object,
      {
          {R"({"type": "mesh", "file": "missing.obj"})",
           R"(2:26: there is no model file "missing.obj"; name one relative to the scene file)"},
          {R"({"type": "mesh", "material": "floor"})",
           R"(2:1: missing key "file" in a mesh object; add it)"},
          {R"({"type": "mesh", "file": "s.json", "transform": {"scale": 0}})",
           R"(2:59: "scale" is 0; give a number other than 0, or [x, y, z] of such)"},
          {R"({"type": "mesh", "file": "s.json", "transform": {"scale": [1, 0, 1]}})",
           R"(2:59: "scale" is 0; give a number other than 0, or [x, y, z] of such)"},
          {R"({"type": "mesh", "file": "s.json", "transform": {"rotate": [1, 0, 1]}})",
           R"(2:50: unknown key "rotate" in a transform; did you mean "rotate_deg"? (known: translate, rotate_deg, scale))"},
          {R"({"type": "mesh", "file": "s.json", "transform": [1]})",
           R"(2:49: a transform is an array; give an object { })"},
          {R"({"type": "mesh", "file": "s.json", "material": "metl"})",
           R"(2:48: unknown material "metl"; did you mean "metal"?)"},
      });
}

TEST(JsonMisuse, Lights) {
  expect_messages(
      with_light,
      {
          {R"({"type": "spere"})",
           R"(2:10: unknown light type "spere"; did you mean "sphere"? (known: sphere, disk, rect, segment, point, sun))"},
          {R"({"position": [0, 0, 0]})",
           R"(2:1: missing key "type" in a light; add one of sphere, disk, rect, segment, point, sun)"},
          {R"(null)", R"(2:1: a light is null; give an object { })"},
          {R"({"type": "sphere", "position": [0, 1, 0], "radius": -0.1, "radiance": [1, 1, 1]})",
           R"(2:53: "radius" is -0.1; give a number above 0 (1e-12 to 1e9))"},
          {R"({"type": "sphere", "position": [0, 1, 0], "radius": 0.1, "radiance": 20})",
           R"(2:70: "radiance" is a number; give [r, g, b], three numbers from 0 to 1e12)"},
          {R"({"type": "sphere", "position": [0, 1, 0], "radius": 0.1, "radiance": [1, 1]})",
           R"(2:70: "radiance" has 2 entries instead of 3; give [r, g, b], three numbers from 0 to 1e12)"},
          {R"({"type": "disk", "position": [0, 1, 0], "normal": [0, 0, 0], "radius": 0.1, "radiance": [1, 1, 1]})",
           R"(2:51: "normal" has no length; give a vector other than zero)"},
          {R"({"type": "rect", "corner": [0, 1, 0], "edge_u": [1, 0, 0], "edge_v": [-1, 0, 0], "radiance": [1, 1, 1]})",
           R"(2:70: "edge_u" and "edge_v" are parallel; give edges that span an area)"},
          {R"({"type": "segment", "from": [0, 1, 0], "to": [0, 1, 0], "radius": 0.1, "radiance": [1, 1, 1]})",
           R"(2:46: the segment light has no length; move "from" or "to")"},
          {R"({"type": "segment", "from": [0, 1, 0], "to": [0, 2, 0], "radiance": [1, 1, 1]})",
           R"(2:1: missing key "radius" in a segment light; add it)"},
          {R"({"type": "sun", "direction": [0, 0, 0], "irradiance": [1, 1, 1]})",
           R"(2:30: "direction" has no length; give a vector other than zero)"},
          {R"({"type": "sun", "direction": [0, -1, 0], "angular_diameter_deg": 180, "irradiance": [1, 1, 1]})",
           R"(2:66: "angular_diameter_deg" is 180; give degrees from 0 to below 180 (at most 179.999))"},
          {R"({"type": "sun", "direction": [0, -1, 0], "radiance": [1, 1, 1]})",
           R"(2:42: unknown key "radiance" in a sun light; did you mean "irradiance"? (known: type, name, keyframes, interpolation, direction, angular_diameter_deg, irradiance))"},
          {R"({"type": "point", "position": [0, -1, 0], "intensity": [1, 1, -1]})",
           R"(2:63: "intensity"[2] is -1; give [r, g, b], three numbers from 0 to 1e12)"},
      });
}

TEST(JsonMisuse, UnknownMaterialWithoutAny) {
  EXPECT_EQ(error_of(R"({"objects": [{"type": "box", "min": [0, 0, 0], "max": [1, 1, 1],
                        "material": "a"}]})"),
            "s.json:2:37: unknown material \"a\"; define it under \"materials\"");
}

TEST(JsonMisuse, DeepNesting) {
  EXPECT_EQ(
      error_of(std::string(100000, '[')),
      "s.json:1:4097: nested deeper than 4096 levels; no scene needs that; look for a missing "
      "bracket");
}

TEST(JsonMisuse, ZeroByte) {
  EXPECT_EQ(error_of(std::string("{\"objects\": []}\0", 16)),
            "s.json:1:16: a zero byte in the text; save the scene as UTF-8 text");
}

TEST(JsonMisuse, NewLineInAKeyStaysOneLine) {
  EXPECT_EQ(error_of("{\"objects\": [], \"a\\nb\": 1}"),
            "s.json:1:17: unknown key \"a b\" in the scene; did you mean \"camera\"? (known: "
            "$schema, camera, cameras, materials, objects, lights, ambient, background)");
}

TEST(JsonMisuse, TooManyVertices) {
  std::string vertices;
  for (int i = 0; i < 1001; ++i) vertices.append(i ? "," : "").append("[0, 0, 0]");
  const std::string polygon =
      std::string(R"({"type": "polygon", "material": "floor", "vertices": [)")
          .append(vertices)
          .append("]}");
  EXPECT_EQ(error_of(with_object(polygon)),
            "s.json:2:54: the polygon has 1001 vertices; give 3 to 1000, or use a mesh file");
}

TEST(JsonMisuse, Files) {
  write_file(scratch().file("whole.json"), R"({"objects": 1})");
  EXPECT_THROW(read_json_scene(scratch().file("whole.json")), InputError);
  write_file(scratch().file("whole.json"), R"({"objects": []})");
  EXPECT_TRUE(read_json_scene(scratch().file("whole.json")).objects.empty());
  EXPECT_THROW(read_json_scene(scratch().file("nothing.json")), InputError);
}

}  // namespace
}  // namespace penumbra::test
