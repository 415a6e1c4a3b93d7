#include "scene/glsl_source.h"

#include <cctype>
#include <filesystem>
#include <string_view>

#include "base/atomic_file.h"
#include "base/error.h"
#include "scene/finish.h"

namespace penumbra {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

// The text with a blank for every comment.
std::string without_comments(const std::string& text) {
  std::string code;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = std::string_view(text).substr(i, 2);
    if (rest != "//" && rest != "/*") {
      code += text[i++];
      continue;
    }
    const std::size_t end = rest == "//" ? text.find('\n', i) : text.find("*/", i + 2);
    i = end == std::string::npos ? text.size() : end + (rest == "//" ? 0 : 2);
    code += ' ';
  }
  return code;
}

// Does the name stand before a parenthesis anywhere?
bool has_function(const std::string& code, std::string_view name) {
  for (std::size_t at = 0; (at = code.find(name, at)) != std::string::npos; at += name.size()) {
    if (at > 0 && is_word(code[at - 1])) continue;
    const std::size_t next = code.find_first_not_of(" \t\r\n", at + name.size());
    if (next != std::string::npos && code[next] == '(') return true;
  }
  return false;
}

}  // namespace

GlslSource read_glsl_source(const std::string& path) {
  GlslSource source;
  source.text = read_file(path);
  source.path = path;
  const std::string code = without_comments(source.text);
  if (!has_function(code, "map") && !has_function(code, "mainImage"))
    throw InputError(Place{path}, "the shader has no map and no mainImage",
                     "give it a float map(vec3 p), the distance from p");
  return source;
}

Scene read_glsl_scene(const std::string& path) {
  Scene scene;
  scene.report.format = "distance field (GLSL)";
  scene.glsl = read_glsl_source(path);
  scene.objects.push_back({std::filesystem::path(path).stem().string()});
  scene.cameras.push_back(default_view());
  scene.lights.push_back(default_sun());
  scene.report.conversions.push_back(
      "a shader has no camera and no light: added a default view "
      "and a sun of 6 degrees");
  return scene;
}

}  // namespace penumbra
