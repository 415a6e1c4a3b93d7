#include "scene/load.h"

#include <algorithm>
#include <filesystem>
#include <span>
#include <string_view>

#include "base/error.h"
#include "scene/finish.h"
#include "scene/glsl_source.h"

namespace penumbra {
namespace {

struct Format {
  std::string_view extension;
  Scene (*read)(const std::string&, const LoadOptions&);
};

// Of formats in which nothing moves.
template <Scene (*read)(const std::string&)>
Scene still(const std::string& path, const LoadOptions&) {
  return read(path);
}

constexpr Format formats[] = {{".json", read_json_scene}, {".gltf", read_gltf},
                              {".glb", read_gltf},        {".obj", still<read_obj>},
                              {".ply", still<read_ply>},  {".ply.gz", still<read_ply>},
                              {".stl", still<read_stl>},  {".glsl", still<read_glsl_scene>}};

// Those that hold triangles.
std::span<const Format> model_formats() {
  return std::span(formats).subspan(1, std::size(formats) - 2);
}

std::string lower_case_name(const std::string& path) {
  std::string name = std::filesystem::path(path).filename().string();
  for (char& c : name)
    if ('A' <= c && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return name;
}

[[noreturn]] void refuse_format(const std::string& path, const std::string& name,
                                std::span<const Format> known) {
  std::string list;
  for (const Format& format : known) (list += list.empty() ? "" : ", ") += format.extension;
  const std::string extension = std::filesystem::path(name).extension().string();
  throw InputError(Place{path},
                   extension.empty() ? "the file name has no extension"
                                     : "unknown file format \"" + extension + "\"",
                   "known are " + list);
}

Scene read_as(const std::string& path, std::span<const Format> known, const LoadOptions& options) {
  const std::string name = lower_case_name(path);
  const auto format =
      std::ranges::find_if(known, [&](const Format& f) { return name.ends_with(f.extension); });
  if (format == known.end()) refuse_format(path, name, known);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw InputError(Place{path}, "there is no such file", "check the name");
  Scene scene = format->read(path, options);
  const auto models = model_formats();
  if (&*format >= models.data() && &*format < models.data() + models.size())
    for (Mesh& mesh : scene.meshes) mesh.file = path;
  return scene;
}

}  // namespace

Scene load_scene(const std::string& path, const LoadOptions& options) {
  Scene scene = read_as(path, formats, options);
  // Only scene files of our own and what is baked of them say what ambient light there is.
  scene.ambient_is_automatic =
      !lower_case_name(path).ends_with(".json") && !scene.stores_visibility;
  finish_scene(scene, path);
  if (options.add_missing_camera_and_light) add_missing_camera_and_light(scene);
  return scene;
}

Scene read_model(const std::string& path, const LoadOptions& options) {
  return read_as(path, model_formats(), options);
}

}  // namespace penumbra
