#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "base/atomic_file.h"
#include "base/error.h"
#include "commands.h"
#include "outputs.h"
#include "scene/info.h"
#include "scene/load.h"
#include "scene/starter.h"
#include "sdf/field.h"

namespace penumbra::app {

void print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw WorkError({"standard output"},
                    std::string("cannot be written (") + std::strerror(errno) + ")",
                    "free some space or choose another output");
}

void run_info(const Arguments& arguments) {
  Scene scene = load_scene(arguments.scene);
  for (std::string& text : sdf::describe_conversions(scene, arguments.conversion))
    scene.report.conversions.push_back(std::move(text));
  for (std::string& text : sdf::field_warnings(scene))
    scene.report.warnings.push_back(std::move(text));
  print(describe(scene));
}

void run_new(const Arguments& arguments) {
  const std::string& file = arguments.scene;
  if (!has_extension(file, ".json"))
    throw InputError({file}, "this is no scene file's name", "let it end in .json");
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored))
    throw WorkError({file}, "this file is there already", "choose another name");
  write_file(file, std::string(arguments.schema ? scene_schema() : starter_scene()));
}

}  // namespace penumbra::app
