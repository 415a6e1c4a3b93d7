#include <algorithm>
#include <filesystem>

#include "base/atomic_file.h"
#include "base/error.h"
#include "commands.h"
#include "device.h"
#include "outputs.h"
#include "prepare.h"
#include "stats.h"

namespace penumbra::app {
namespace {

// What a shader of one function has no room for.
void refuse_layers(const Arguments& a) {
  if (!a.aovs.empty())
    throw InputError("--aov: a shader shows one picture", "leave it out, or use penumbra render");
}

}  // namespace

void run_export(Arguments& arguments, Console& console) {
  if (!has_extension(arguments.output, ".glsl"))
    throw InputError({arguments.output}, "this is no shader's name", "let it end in .glsl");
  refuse_layers(arguments);
  check_outputs(arguments);
  const auto& given = arguments.given;
  if (std::find(given.begin(), given.end(), "--spp") == given.end()) arguments.render.spp = 1;
  if (arguments.render.spp > 64)
    throw InputError("--spp: a shader takes at most 64 samples a pixel", "give 1 to 64");
  const Scene scene = prepare_scene(arguments, console);
  arguments.render.camera = chosen_camera(scene, arguments.camera);
  arguments.entry = Entry::map;
  adapt_to_gl(arguments, scene, console);
  std::vector<std::string> warnings;
  const std::string name = std::filesystem::path(arguments.scene).filename().string();
  const std::string text = export_shadertoy(scene, arguments.render, name, console, warnings);
  for (const std::string& warning : warnings) console.warn(warning);
  write_file(arguments.output, text);
  if (!arguments.stats.empty()) write_stats(arguments.stats, common_stats(arguments, scene, 0));
}

}  // namespace penumbra::app
