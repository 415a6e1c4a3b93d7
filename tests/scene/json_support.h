// Scenes as text, for the tests of the JSON reader.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"
#include "scene/json/builder.h"
#include "scene/load.h"

namespace penumbra::test {

/// A folder of its own for each test program that runs, removed at its end.
class ScratchFolder {
 public:
  ScratchFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("penumbra_json_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  /// The text without the folder's name.
  std::string strip(std::string text) const {
    const std::string prefix = path_.string() + "/";
    for (std::size_t at; (at = text.find(prefix)) != std::string::npos;)
      text.erase(at, prefix.size());
    return text;
  }

 private:
  std::filesystem::path path_;
};

inline const ScratchFolder& scratch() {
  static const ScratchFolder folder;
  return folder;
}

/// Files that the text names are looked for in the scratch folder.
inline Scene read_text(const std::string& text) {
  return json::read_scene(json::Document(scratch().file("s.json"), text));
}

/// The one-line message for a scene that must be refused, the file called s.json.
inline std::string error_of(const std::string& text) {
  try {
    read_text(text);
  } catch (const InputError& e) {
    return scratch().strip(e.what());
  }
  return "(no error)";
}

/// A scene of one white floor material, with one object or light among others.
inline std::string with_object(const std::string& object) {
  return R"({"materials": {"floor": {}, "metal": {}}, "objects": [)"
         "\n" +
         object + "]}";
}
inline std::string with_light(const std::string& light) {
  return R"({"objects": [], "lights": [)"
         "\n" +
         light + "]}";
}
inline std::string with_material(const std::string& material) {
  return R"({"objects": [], "materials": {"m":)"
         "\n" +
         material + "}}";
}
inline std::string with_camera(const std::string& camera) {
  return R"({"objects": [], "camera":)"
         "\n" +
         camera + "}";
}

}  // namespace penumbra::test
