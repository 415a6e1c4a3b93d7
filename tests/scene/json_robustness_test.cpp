// Whatever the bytes: a scene or an InputError of one line, never anything else.
#include <gtest/gtest.h>

#include <random>

#include "json_support.h"
#include "scene/starter.h"

namespace penumbra::test {
namespace {

// True if the text is a scene.
bool is_scene(const std::string& text) {
  try {
    read_text(text);
    return true;
  } catch (const InputError& e) {
    const std::string message = e.what();
    EXPECT_TRUE(message.find('\n') == std::string::npos && message.find("; ") != std::string::npos)
        << message;
    return false;
  }
}

// Covers every type of object and light, so that mutations reach them all.
std::string rich_scene() {
  return R"({"cameras": {"a": {"position": [3, 2, 4], "look_at": [0, 0.4, 0], "up": [0, 1, 0],
      "vertical_fov_deg": 40}}, "ambient": [1, 1, 1], "background": [0, 0, 0],
    "materials": {"m": {"diffuse": [0.8, 0.8, 0.8], "specular": [0, 0, 0], "roughness": 0.5,
      "mirror": 0.5, "emission": [0, 0, 0]}, "e": {"emission": [1, 1, 1], "mirror": [0, 0, 0]}},
    "objects": [
      {"type": "quad", "corner": [-4, 0, 4], "edge_u": [8, 0, 0], "edge_v": [0, 0, -8], "material": "m"},
      {"type": "sphere", "center": [0, 0.5, 0], "radius": 0.5, "material": "e"},
      {"type": "box", "min": [1, 0, 0], "max": [2, 1, 1], "material": "m"},
      {"type": "polygon", "vertices": [[0,0,0],[4,0,0],[4,3,0],[3,3,0],[3,1,0],[1,1,0]], "material": "m"},
      {"type": "mesh", "file": "tri.obj", "transform": {"translate": [1, 2, 3],
        "rotate_deg": [10, 20, 30], "scale": [1, 2, 3]}},
      {"type": "sdf", "material": "m", "root": {"op": "smooth_union", "k": 0.1, "children": [
        {"shape": "box", "min": [0, 0, 0], "max": [1, 1, 1], "material": "e"},
        {"op": "mirror", "axes": "xz", "child": {"shape": "plane", "normal": [0, 1, 0], "offset": 2}},
        {"op": "repeat", "spacing": [1, 0, 2], "limit": [3, 0, 1], "child": {"shape": "extrusion",
          "half_height": 1, "profile": {"shape": "polygon", "vertices": [[0,0],[1,0],[0,1]]}}}]}}],
    "lights": [
      {"type": "sphere", "position": [1, 4, 1], "radius": 0.3, "radiance": [20, 20, 20]},
      {"type": "disk", "position": [0, 4, 0], "normal": [0, -1, 0], "radius": 0.4, "radiance": [1, 1, 1]},
      {"type": "rect", "corner": [0, 4, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, 1], "radiance": [1, 1, 1]},
      {"type": "segment", "from": [0, 4, 0], "to": [1, 4, 0], "radius": 0.01, "radiance": [1, 1, 1]},
      {"type": "point", "position": [0, 4, 0], "intensity": [1, 1, 1]},
      {"type": "sun", "direction": [-0.3, -0.9, -0.2], "angular_diameter_deg": 0.53, "irradiance": [1, 1, 1]}]})";
}

TEST(JsonRobustness, EveryPrefixOfTheStarterScene) {
  const std::string starter(starter_scene());
  const std::size_t end = starter.find_last_of('}') + 1;
  ASSERT_TRUE(is_scene(starter));
  for (std::size_t length = 0; length < starter.size(); ++length)
    EXPECT_EQ(is_scene(starter.substr(0, length)), length >= end) << length;
}

TEST(JsonRobustness, MutatedBytes) {
  write_file(scratch().file("tri.obj"), "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
  const std::string texts[] = {rich_scene(), std::string(starter_scene())};
  for (const std::string& text : texts) ASSERT_TRUE(is_scene(text));
  std::mt19937 random(1);
  const std::string alphabet = "{}[]\",:/*\\-+.0123456789eE \n\xC3\xFFtfn";
  int survived = 0;
  for (int round = 0; round < 2000; ++round) {
    std::string text = texts[round % 2];
    for (unsigned change = 0; change <= random() % 4; ++change) {
      const std::size_t at = random() % text.size();
      const char c = alphabet[random() % alphabet.size()];
      switch (random() % 4) {
        case 0:
          text[at] = c;
          break;
        case 1:
          text.insert(at, 1, c);
          break;
        case 2:
          text.erase(at, 1 + random() % 20);
          break;
        default:
          text[at] = static_cast<char>(random());
      }
    }
    survived += is_scene(text);
  }
  EXPECT_GT(survived, 50) << "mutations too wild to test anything but the syntax";
}

TEST(JsonRobustness, RandomBytes) {
  std::mt19937 random(2);
  for (int round = 0; round < 300; ++round) {
    std::string text(random() % 300, ' ');
    for (char& c : text) c = static_cast<char>(random());
    EXPECT_FALSE(is_scene(text));
  }
}

TEST(JsonRobustness, LongRunsOfOneThing) {
  for (const std::string part :
       {"[", "{", "\"", "{\"a\":", "[1,", "/*", "//", "\\", "-", "1", "\n"}) {
    std::string text;
    while (text.size() < 200000) text += part;
    EXPECT_FALSE(is_scene(text)) << part;
    EXPECT_FALSE(is_scene("{\"objects\": [" + text)) << part;
  }
}

}  // namespace
}  // namespace penumbra::test
