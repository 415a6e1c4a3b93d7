// Distance fields as text, for the tests.
#pragma once

#include <string>
#include <vector>

#include "scene/json/builder.h"

namespace penumbra::test {

inline Scene scene_with(const std::string& objects) {
  return json::read_scene(json::Document(
      "s.json", R"({"materials": {"a": {}, "b": {}}, "objects": [)" + objects + "]}"));
}

inline Scene scene_of(const std::string& root) {
  return scene_with(R"({"type": "sdf", "material": "a", "root": )" + root + "}");
}

/// One of each shape, off the origin.
inline std::vector<std::string> shapes() {
  const std::string c = R"("center": [0.3, -0.2, 0.1])";
  return {
      R"({"shape": "sphere", )" + c + R"(, "radius": 0.7})",
      R"({"shape": "box", )" + c + R"(, "half_size": [0.5, 0.3, 0.8]})",
      R"({"shape": "round_box", )" + c + R"(, "half_size": [0.5, 0.3, 0.8], "radius": 0.1})",
      R"({"shape": "ellipsoid", )" + c + R"(, "radii": [0.9, 0.4, 0.3]})",
      R"({"shape": "torus", )" + c + R"(, "major_radius": 0.7, "minor_radius": 0.2})",
      R"({"shape": "capped_torus", )" + c +
          R"(, "aperture_deg": 110, "major_radius": 0.7, "minor_radius": 0.15})",
      R"({"shape": "capsule", "from": [-0.5, 0, 0.2], "to": [0.6, 0.5, -0.1], "radius": 0.2})",
      R"({"shape": "cylinder", )" + c + R"(, "half_height": 0.4, "radius": 0.5})",
      R"({"shape": "capped_cone", )" + c +
          R"(, "half_height": 0.4, "radius_bottom": 0.6, "radius_top": 0.2})",
      R"({"shape": "cone", "apex": [0.1, 0.5, 0], "angle_deg": 30, "height": 1.1})",
      R"({"shape": "plane", "normal": [1, 2, -0.5], "offset": 0.2})",
      R"({"shape": "hexagonal_prism", )" + c + R"(, "radius": 0.5, "half_height": 0.3})",
      R"({"shape": "octahedron", )" + c + R"(, "radius": 0.8})",
      R"({"shape": "link", )" + c +
          R"(, "half_length": 0.3, "major_radius": 0.4, "minor_radius": 0.1})",
      R"({"shape": "extrusion", )" + c +
          R"(, "half_height": 0.3, "profile": {"shape": "circle", "radius": 0.5}})",
      R"({"shape": "extrusion", )" + c +
          R"(, "half_height": 0.3, "profile": {"shape": "box", "half_size": [0.5, 0.2]}})",
      R"({"shape": "extrusion", )" + c + R"(, "half_height": 0.3, "profile": {"shape": "polygon",
          "vertices": [[0, 0], [0.8, 0.1], [0.3, 0.3], [0.2, 0.9]]}})",
      R"({"shape": "revolution", )" + c +
          R"(, "offset": 0.6, "profile": {"shape": "circle", "radius": 0.2}})",
      R"({"shape": "revolution", )" + c +
          R"(, "offset": 0.6, "profile": {"shape": "box", "half_size": [0.2, 0.1]}})",
      R"({"shape": "revolution", )" + c + R"(, "offset": 0.5, "profile": {"shape": "polygon",
          "vertices": [[0, 0], [0.4, 0.1], [0.1, 0.2], [0.1, 0.5]]}})",
  };
}

/// One of each operator and transform about a pair of shapes, and nests of them.
inline std::vector<std::string> operators() {
  const std::string ball = R"({"shape": "sphere", "center": [0.4, 0.1, 0.2], "radius": 0.5})";
  const std::string brick =
      R"({"shape": "box", "center": [-0.2, 0, 0.1], "half_size": [0.5, 0.3, 0.2], "material": "b"})";
  const std::string rod =
      R"({"shape": "cylinder", "center": [0.1, 0.2, 0], "half_height": 0.6, "radius": 0.2})";
  const std::string all = R"("children": [)" + brick + "," + ball + "," + rod + "]}";
  const std::string one = R"("child": )" + brick + "}";
  std::vector<std::string> list;
  for (const std::string op : {"union", "intersection", "difference"})
    list.push_back(R"({"op": ")" + op + R"(", )" + all);
  for (const std::string op : {"union", "intersection", "difference"})
    list.push_back(R"({"op": "smooth_)" + op + R"(", "k": 0.3, )" + all);
  list.push_back(R"({"op": "smooth_union", "k": 0, )" + all);
  for (const std::string start :
       {R"("onion", "thickness": 0.05)", R"("round", "radius": 0.1)",
        R"("displace", "amplitude": 0.05, "frequency": [7, 5, 9])",
        R"("translate", "offset": [0.3, 0.1, -0.6])", R"("rotate", "rotate_deg": [20, 40, 60])",
        R"("scale", "factor": 1.7)", R"("scale", "factor": -0.6)",
        R"("scale", "factor": [1.5, 0.5, -1])", R"("mirror", "axes": "xz")",
        R"("repeat", "spacing": [1.5, 0, 1.2])",
        R"("repeat", "spacing": [1.3, 0.9, 0], "limit": [2, 1, 0])", R"("twist", "rate": 1.5)",
        R"("bend", "rate": 0.8)", R"("elongate", "half_size": [0.2, 0, 0.3])"})
    list.push_back(R"({"op": )" + start + ", " + one);
  // Nests: operators in operators, transforms over several children, each after another.
  const std::size_t simple = list.size();
  for (std::size_t i = 0; i < simple; ++i) {
    const std::string &a = list[i], &b = list[(i * 7 + 3) % simple];
    list.push_back(
        R"({"op": "rotate", "rotate_deg": [10, 20, 30], "child": {"op": "difference", "children": [)" +
        rod + "," + a + "," + b + "]}}");
    list.push_back(
        R"({"op": "union", "children": [)" + ball +
        R"(, {"op": "scale", "factor": 0.8, "child": )" + a +
        R"(}, {"op": "translate", "offset": [0.5, 0, 0], "child": {"op": "union", "children": [)" +
        b + "," + rod + "]}}]}");
    list.push_back(R"({"op": "smooth_union", "k": 0.2, "children": [)" + a + "," + b + "," + ball +
                   "]}");
    list.push_back(R"({"op": "twist", "rate": 0.7, "child": {"op": "intersection", "children": [)" +
                   brick + R"(, {"op": "round", "radius": 0.05, "child": )" + a + "}]}}");
  }
  return list;
}

}  // namespace penumbra::test
