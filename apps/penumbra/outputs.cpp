#include "outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "bake_files.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "image/exr.h"
#include "image/heat_map.h"
#include "image/png.h"

namespace penumbra::app {
namespace {

std::vector<std::string> output_files(const Arguments& a) {
  std::vector<std::string> files;
  if (!a.output.empty()) files.push_back(a.output);
  for (const AovRequest& aov : a.aovs) files.push_back(aov.file);
  if (!a.stats.empty()) files.push_back(a.stats);
  if (!a.bake.preview.empty()) files.push_back(a.bake.preview);
  if (a.bake.lightmap) files.push_back(description_file(a));
  if (a.bake.lightmap || a.bake.hdr) files.push_back(page_file(a, 0, 1));
  return files;
}

// Layer names are parted by dots, so lights keep only what cannot be mistaken.
std::string channel_name(const Light& light, std::size_t index) {
  std::string name = light.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-') c = '_';
  return name.empty() ? std::to_string(index) : name;
}

std::vector<std::string> channel_names(const std::vector<Light>& lights) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    std::string name = channel_name(lights[i], i);
    while (!taken.insert(name).second) name += fmt::format("_{}", i);
    names.push_back(name);
  }
  return names;
}

void add_layers(const std::string& name, const Scene& scene, const RenderResult& result,
                std::vector<ExrLayer>& layers) {
  if (name == "depth") layers.push_back({name, {"Z"}, &result.depth});
  if (name == "normal") layers.push_back({name, {"X", "Y", "Z"}, &result.normal});
  if (name == "steps") layers.push_back({name, {"Y"}, &result.steps});
  if (name == "error") layers.push_back({name, {"Y"}, &result.error});
  if (name != "visibility") return;
  const std::vector<std::string> channels = channel_names(scene.lights);
  for (std::size_t i = 0; i < channels.size(); ++i)
    layers.push_back({name, {channels[i]}, &result.visibility[i]});
}

ExrAttributes attributes_of(const RenderResult& result) {
  return {{"software", "penumbra " PENUMBRA_VERSION},
          {"exposure", fmt::format("{} EV", result.stats.exposure_ev)}};
}

void write_layers(const std::string& file, const Scene& scene, const RenderResult& result) {
  std::vector<ExrLayer> layers{{"", {"R", "G", "B"}, &result.color}};
  for (const char* name : {"visibility", "depth", "normal"})
    add_layers(name, scene, result, layers);
  if (!result.error.data.empty()) add_layers("error", scene, result, layers);
  write_exr(file, layers, attributes_of(result));
}

}  // namespace

bool has_extension(const std::string& file, const std::string& extension) {
  return file.size() > extension.size() &&
         std::equal(extension.rbegin(), extension.rend(), file.rbegin(), [](char a, char b) {
           return a == std::tolower(static_cast<unsigned char>(b));
         });
}

void check_outputs(const Arguments& a) {
  const bool is_picture = a.command == Command::render || a.command == Command::animate;
  if (is_picture && !has_extension(a.output, ".png") && !has_extension(a.output, ".exr"))
    throw InputError({a.output}, "this is no picture format that can be written",
                     "let it end in .png or .exr");
  if (a.command == Command::bake && !has_extension(a.output, ".glb"))
    throw InputError({a.output}, "a bake is written as binary glTF", "let it end in .glb");
  std::set<std::filesystem::path> names;
  std::error_code ignored;
  for (const std::string& file : output_files(a)) {
    if (!names.insert(std::filesystem::weakly_canonical(file, ignored)).second)
      throw InputError({file}, "two outputs have this name", "give each its own");
    if (std::filesystem::equivalent(file, a.scene, ignored))
      throw InputError({file}, "this is the scene itself", "name another file for the output");
    const AtomicFile can_be_written(file);
  }
}

void write_outputs(const Arguments& a, const Scene& scene, const RenderResult& result) {
  if (has_extension(a.output, ".png"))
    write_png(a.output, result.color, result.stats.exposure_ev);
  else
    write_layers(a.output, scene, result);
  for (const AovRequest& aov : a.aovs) {
    if (has_extension(aov.file, ".png")) {
      write_png(aov.file, heat_map(result.steps));
      continue;
    }
    std::vector<ExrLayer> layers;
    add_layers(aov.name, scene, result, layers);
    write_exr(aov.file, layers, attributes_of(result));
  }
}

}  // namespace penumbra::app
