#include "bake/preview.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <string_view>

#include "base/atomic_file.h"
#include "base/error.h"

namespace penumbra {
std::string_view viewer_text(std::string_view name);
}

namespace penumbra::bake {
namespace {

struct Module {
  const char *specifier, *file;
};
// What GLTFLoader and OrbitControls import, directly or not.
constexpr std::array<Module, 6> modules{{{"three", "three.module.js"},
                                         {"viewer/three.core", "three.core.js"},
                                         {"viewer/GLTFLoader", "GLTFLoader.js"},
                                         {"viewer/OrbitControls", "OrbitControls.js"},
                                         {"viewer/BufferGeometryUtils", "BufferGeometryUtils.js"},
                                         {"viewer/SkeletonUtils", "SkeletonUtils.js"}}};

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63];
  }
  return out;
}

/// Modules in data: URLs have no folder: './x/NAME.js' becomes the import map's 'viewer/NAME'.
std::string without_folders(const std::string& script) {
  static const std::regex relative(R"re(from '\.[^']*/([A-Za-z.]+)\.js')re");
  return std::regex_replace(script, relative, "from 'viewer/$1'");
}

std::string import_map(const std::string& folder) {
  std::string map = "{\"imports\": {";
  for (const Module& module : modules) {
    const std::string script = without_folders(read_file(folder + "/" + module.file));
    if (map.back() != '{') map += ",";
    map += std::string("\n\"") + module.specifier + "\": \"data:text/javascript;base64," +
           base64(script) + "\"";
  }
  return map + "\n}}";
}

std::string html_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '&')
      out += "&amp;";
    else
      out += c;
  }
  return out;
}

}  // namespace

std::string viewer_folder() {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const char* named = std::getenv("PENUMBRA_VIEWER");
  const fs::path folder =
      named != nullptr ? fs::path(named)
                       : fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path() /
                             "share/penumbra/viewer";
  for (const Module& module : modules)
    if (!fs::is_regular_file(folder / module.file, ignored))
      throw InputError(
          {folder.string()},
          std::string("the viewer of --preview is not installed: there is no ") + module.file,
          "run scripts/get-viewer, or let PENUMBRA_VIEWER name its folder");
  return folder.string();
}

std::string preview_html(const std::string& title, const std::string& glb,
                         const std::string& folder) {
  std::string page(viewer_text("viewer.html"));
  const auto put = [&](const std::string& name, const std::string& value) {
    page.replace(page.find(name), name.size(), value);
  };
  put("@title@", html_escaped(title));
  put("@imports@", import_map(folder));
  put("@glb@", base64(glb));
  return page;
}

}  // namespace penumbra::bake
