#include <fmt/format.h>

#include <algorithm>

#include "bake/stored_light.h"
#include "baked_light.h"
#include "base/error.h"
#include "commands.h"
#include "device.h"
#include "memory.h"
#include "outputs.h"
#include "prepare.h"
#include "stats.h"

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

bool has(const Arguments& arguments, const char* option) {
  return std::ranges::find(arguments.given, option) != arguments.given.end();
}

// A file with visibility in it is shown by it unless another method is named.
void prefer_stored(Arguments& arguments, const Scene& scene, Console& console) {
  ShadowKind& kind = arguments.render.shadows.kind;
  if (!scene.stores_visibility) return;
  if (!has(arguments, "--shadows") && arguments.device != Device::gl)
    kind = ShadowKind::heckbert_herf;
  if (kind != ShadowKind::heckbert_herf) return;
  for (const char* option : {"--light-samples", "--texel-size", "--sample-grid"})
    if (has(arguments, option))
      console.warn(fmt::format("{} has no effect: the file holds baked visibility", option));
}

// What the file knows of its lights, if that is to be shown.
std::unique_ptr<bake::StoredLight> stored_light(const Arguments& arguments, const Scene& scene,
                                                Console& console) {
  if (arguments.render.shadows.kind != ShadowKind::heckbert_herf) return nullptr;
  auto stored = std::make_unique<bake::StoredLight>(arguments.scene, scene);
  console.remark(fmt::format("shadows: {} stored in the file", stored->what()));
  return stored;
}

// Counts bytes of structures and seconds of building them.
RenderResult render_by_device(Arguments& arguments, const Scene& scene, std::size_t& bytes,
                              Phases& phases, Console& console) {
  if (draws_with_gl(arguments, scene)) {
    adapt_to_gl(arguments, scene, console);
    return render_gl(scene, arguments.render, arguments.entry, console);
  }
  const Stopwatch build;
  if (arguments.render.shadows.kind == ShadowKind::heckbert_herf && !scene.stores_visibility) {
    const BakedLight baked(scene, arguments, console);
    phases.build = build.seconds();
    bytes = baked.world().memory_bytes();
    arguments.render.known = &baked.light();
    return render(baked.world(), arguments.render, console);
  }
  const std::unique_ptr<World> world = build_world(scene, arguments, console);
  const auto stored = stored_light(arguments, scene, console);
  if (stored) arguments.render.known = stored.get();
  phases.build = build.seconds();
  bytes = world->memory_bytes();
  return render(*world, arguments.render, console);
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
  check_steps_are_counted(arguments, scene);
  std::size_t bytes = 0;
  const RenderResult result = render_by_device(arguments, scene, bytes, phases, console);
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
  if (!arguments.stats.empty())
    write_stats(arguments.stats, stats_of(arguments, scene, bytes, result.stats, phases));
}

}  // namespace penumbra::app
