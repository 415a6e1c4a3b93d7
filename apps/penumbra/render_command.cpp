#include <fmt/format.h>

#include <algorithm>

#include "auto_method.h"
#include "base/error.h"
#include "commands.h"
#include "device.h"
#include "memory.h"
#include "outputs.h"
#include "picture.h"
#include "prepare.h"
#include "stats.h"
#include "stored_picture.h"

namespace penumbra::app {
namespace {

void want_layers(Arguments& arguments) {
  RenderOptions& options = arguments.render;
  if (!has_extension(arguments.output, ".exr")) return;
  options.want_visibility = options.want_depth = options.want_normal = true;
  if (options.shadows.kind == ShadowKind::area && options.shadows.error) options.want_error = true;
}

void check_visibility_has_lights(const Arguments& arguments, const Scene& scene) {
  const bool wanted = std::any_of(arguments.aovs.begin(), arguments.aovs.end(),
                                  [](const AovRequest& aov) { return aov.name == "visibility"; });
  if (wanted && scene.lights.empty())
    throw InputError("--aov visibility: the scene has no light to be seen",
                     "add one with --light or leave it out");
}

void check_steps_are_counted(const Arguments& arguments, const Scene& scene) {
  if (!arguments.render.want_steps) return;
  if (!arguments.render.shadows.marches_field())
    throw InputError("--aov steps: this method does not march", "choose an sdf-* method");
  if (is_own_picture(arguments, scene))
    throw InputError("--aov steps: a mainImage does not march",
                     "choose --entry map, or leave it out");
}

// Seconds that the commands measure themselves.
struct Phases {
  double load = 0, build = 0, write = 0;
};

Json::Value stats_of(const Arguments& arguments, const Scene& scene, std::size_t structure_bytes,
                     const RenderStats& render, const Phases& phases) {
  Json::Value json = common_stats(arguments, scene, structure_bytes);
  json["seconds"]["load"] = phases.load;
  json["seconds"]["build"] = phases.build + render.seconds_build;
  json["seconds"]["render"] = render.seconds_render;
  json["seconds"]["write"] = phases.write;
  json["rays"]["primary"] = static_cast<Json::UInt64>(render.primary_rays);
  json["rays"]["unfinished"] = static_cast<Json::UInt64>(render.unfinished_rays);
  json["rays"]["mirror"] = static_cast<Json::UInt64>(render.mirror_rays);
  add_shadow_counts(json, render.shadows);
  json["exposure_ev"] = render.exposure_ev;
  json["size"].append(arguments.render.width);
  json["size"].append(arguments.render.height);
  json["samples_per_pixel"] = arguments.render.spp;
  if (!render.device.empty()) {
    json["device"] = render.device;
    json["field"]["steps"] = static_cast<Json::UInt64>(render.field_steps);
    json["field"]["unfinished_samples"] = static_cast<Json::UInt64>(render.unfinished);
  }
  return json;
}

}  // namespace

void run_render(Arguments& arguments, Console& console) {
  want_layers(arguments);
  check_outputs(arguments);
  check_picture_fits(arguments, arguments.lights.size());
  warn_of_idle_options(arguments, console);
  Phases phases;
  const Stopwatch load;
  const Scene scene = prepare_scene(arguments, console);
  phases.load = load.seconds();
  prefer_stored(arguments, scene, console);
  arguments.render.camera = chosen_camera(scene, arguments.camera);
  check_picture_fits(arguments, scene.lights.size());
  check_visibility_has_lights(arguments, scene);
  const Json::Value chosen =
      arguments.choose_method ? choose_method(arguments, scene, console) : Json::Value();
  check_steps_are_counted(arguments, scene);
  const Picture picture = make_picture(arguments, scene, console);
  const RenderResult& result = picture.result;
  phases.build = picture.seconds_build;
  for (const std::string& text : result.warnings) console.warn(text);
  warn_of_unfinished(result.stats.shadows, console);
  if (const auto lost = result.stats.unfinished_rays; lost > 0)
    console.warn(
        fmt::format("{} camera or mirror rays ran out of steps in a distance field and see the "
                    "background: some operator makes it very steep",
                    lost));
  console.remark(fmt::format("exposure: {:.2f} EV{}", result.stats.exposure_ev,
                             arguments.render.exposure_ev ? "" : " (from the scene)"));
  const Stopwatch write;
  console.start("write", 0);
  write_outputs(arguments, scene, result);
  console.finish();
  phases.write = write.seconds();
  if (arguments.stats.empty()) return;
  Json::Value stats = stats_of(arguments, scene, picture.structure_bytes, result.stats, phases);
  if (!chosen.isNull()) stats["chosen"] = chosen;
  write_stats(arguments.stats, stats);
}

}  // namespace penumbra::app
