#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "bake/bake_store.h"
#include "bake/preview.h"
#include "bake/receivers.h"
#include "bake/triangulate.h"
#include "bake_files.h"
#include "base/error.h"
#include "commands.h"
#include "image/exr.h"
#include "interrupt.h"
#include "memory.h"
#include "outputs.h"
#include "prepare.h"
#include "render/exposure.h"
#include "stats.h"

namespace penumbra::app {
namespace {

void check_store_options(const Arguments& a) {
  if (a.bake.store == bake::Store::radiance) return;
  for (const char* option : {"--error", "--time-limit", "--preview", "--exposure"})
    if (std::ranges::find(a.given, option) != a.given.end())
      throw InputError(fmt::format("{}: it belongs to --store radiance", option),
                       "leave it or --store out");
  if (a.bake.lightmap || a.bake.hdr)
    throw InputError(
        fmt::format("{}: it belongs to --store radiance", a.bake.lightmap ? "--lightmap" : "--hdr"),
        "leave it or --store out");
}

void check_lightmap_options(const Arguments& a) {
  if (a.bake.lightmap && a.bake.hdr)
    throw InputError("--hdr: a lightmap always has its EXR beside it", "leave --hdr out");
  if (a.bake.lightmap && !a.bake.preview.empty())
    throw InputError("--preview: it shows radiance, not lightmaps", "leave --lightmap out");
}

bool is_in_passes(const Arguments& a) { return a.bake.error > 0 || a.bake.time_limit; }

void check_error(const Arguments& a) {
  if (is_in_passes(a) && a.bake.light.placement != bake::SamplePlacement::jittered)
    throw InputError("--sample-grid: passes need points that differ, and these lie the same in all",
                     "leave it out, or --error and --time-limit");
  const float points = static_cast<float>(a.bake.light.light_samples) * a.bake.light.samples_scale;
  if (a.bake.error > 0 && points > 0 && points <= 16)
    throw InputError("--error: no chart is done before 16 points on each light",
                     "give more --light-samples");
}

void warn_of_surfaces(const Scene& scene, const bake::Plan& plan, bool radiance, Console& console) {
  constexpr std::size_t shown = 5;
  const auto names = [](const std::vector<std::string>& all) {
    const std::vector<std::string> some(
        all.begin(), all.begin() + std::min<std::ptrdiff_t>(shown, std::ssize(all)));
    return fmt::format("{}{}", fmt::join(some, ", "),
                       all.size() > shown ? fmt::format(" and {} more", all.size() - shown) : "");
  };
  if (!plan.remarks.coarse.empty())
    console.warn(fmt::format("texels are coarser than asked for, to fit into one texture: {}",
                             names(plan.remarks.coarse)));
  if (!plan.remarks.blurred.empty() && radiance)
    console.warn(
        fmt::format("base-colour textures are finer than the texels and look blurred: {}; "
                    "a smaller --texel-size or --lightmap keeps them",
                    names(plan.remarks.blurred)));
  if (!plan.remarks.squeezed.empty())
    console.warn(fmt::format("some triangles have no texels of their own in the texture layout: {}",
                             names(plan.remarks.squeezed)));
  std::vector<std::string> shiny;
  for (const Instance& instance : scene.instances) {
    const Material& m = scene.materials[instance.material];
    const bool turns_with_view = max_component(m.mirror) > 0 || max_component(m.specular) > 0.1f ||
                                 (m.is_metallic_roughness && m.metallic > 0.5f);
    if (turns_with_view && std::ranges::find(shiny, m.name) == shiny.end()) shiny.push_back(m.name);
  }
  if (!shiny.empty() && radiance)
    console.warn(fmt::format("highlights and mirrors depend on the viewer and are not baked: {}",
                             names(shiny)));
}

Brightness brightness_of(const World& world, const Arguments& a, const DirectLight& lights,
                         const MaterialLookup& materials) {
  const Scene& scene = world.scene();
  const int camera = chosen_camera(scene, a.camera);
  const CameraRays coarse(scene.cameras[static_cast<std::size_t>(camera)], exposure_grid_width,
                          exposure_grid_height);
  Brightness bright = find_brightness(world, coarse, lights, materials);
  bright.exposure_ev = a.render.exposure_ev.value_or(bright.exposure_ev);
  return bright;
}

/// Where a glTF file's materials are kept.
std::optional<GltfMaterials> source_of(const Arguments& a) {
  std::string ending = std::filesystem::path(a.scene).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const bool keeps = a.bake.lightmap || a.bake.store != bake::Store::radiance;
  if (!keeps || (ending != ".glb" && ending != ".gltf")) return {};
  return read_gltf_materials(a.scene);
}

bake::PassOptions pass_options(const Arguments& a) {
  bake::PassOptions options;
  options.error = a.bake.error;
  if (a.bake.time_limit)
    options.deadline =
        std::chrono::steady_clock::now() +
        std::chrono::microseconds(static_cast<std::int64_t>(1e6 * double{*a.bake.time_limit}));
  return options;
}

void tell(const bake::BakeStats& stats, const bake::Plan& plan, Console& console) {
  console.remark(fmt::format("{} charts, {} texels of {:.3g} m, {} texture{}", stats.charts,
                             stats.texels, plan.texel_size, stats.pages,
                             stats.pages == 1 ? "" : "s"));
  if (was_interrupted() && stats.hasty_charts > 0)
    console.warn(fmt::format("stopped early: {} of {} charts have {:.3g} points a light",
                             stats.hasty_charts, stats.charts, stats.light_points));
  else if (was_interrupted())
    console.warn("stopped early: what there is, is written");
  if (stats.light_points > 0 && stats.hasty_charts == 0)
    console.remark(fmt::format("{:.3g} points a light on average", stats.light_points));
  if (stats.vertex_charts > 0)
    console.remark(
        fmt::format("{} charts are smooth and became vertex colours, within one 8-bit "
                    "step: {:.1f} MB of texels saved",
                    stats.vertex_charts, 3e-6 * static_cast<double>(stats.saved_texels)));
}

Json::Value stats_of(const Arguments& a, const Scene& scene, const World& world,
                     const bake::Plan& plan, const bake::BakeStats& bake, double seconds) {
  Json::Value json = common_stats(a, scene, world.memory_bytes());
  json["seconds"]["bake"] = seconds;
  json["charts"] = static_cast<Json::UInt64>(bake.charts);
  json["vertex_charts"] = static_cast<Json::UInt64>(bake.vertex_charts);
  json["texels"] = static_cast<Json::UInt64>(bake.texels);
  json["textures"] = static_cast<Json::UInt64>(bake.pages);
  if (bake.light_points > 0 && bake.hasty_charts == 0) json["points_per_light"] = bake.light_points;
  json["texel_size"] = plan.texel_size;
  return json;
}

}  // namespace

void run_bake(Arguments& a, Console& console) {
  check_store_options(a);
  check_lightmap_options(a);
  check_error(a);
  check_outputs(a);
  if (!a.bake.preview.empty()) bake::viewer_folder();  // refused now rather than after the work
  if (a.bake.textures.most_bytes == 0) a.bake.textures.most_bytes = available_memory() / 2;
  a.bake.textures.in_passes = is_in_passes(a);
  const Scene loaded = prepare_scene(a, console);
  if (loaded.glsl)
    throw InputError({a.scene}, "a shader has no surfaces to bake", "use penumbra render");
  const Scene scene = bake::triangulated(loaded, a.conversion);
  const bake::Plan plan = bake::make_plan(scene, a.bake.textures);
  const bool radiance = a.bake.store == bake::Store::radiance;
  warn_of_surfaces(scene, plan, radiance, console);
  console.start("build", 0);
  const World world(scene, {.cone_tree = false});
  console.finish();
  const LightViews views(scene);
  const DirectLight lights(views);
  const MaterialLookup materials(scene);
  const Brightness bright = brightness_of(world, a, lights, materials);
  a.bake.light.seed = a.render.seed;
  a.bake.light.instance_scale = bake::samples_scales(scene);
  const bake::BakedIrradiance irradiance(world, a.bake.light);
  bake::BakeInput input{scene,
                        irradiance,
                        lights,
                        materials,
                        bright.ambient,
                        bright.exposure_ev,
                        is_in_passes(a) ? &irradiance : nullptr,
                        {}};
  const bake::PageSink write_page = [&](int page, std::size_t count, const Image& image) {
    write_exr(page_file(a, page, count), {{"", {"R", "G", "B"}, &image, a.bake.lightmap}});
  };
  const std::optional<GltfMaterials> source = source_of(a);
  if (source) input.source = &*source;
  std::optional<FinishOnInterrupt> finish;
  if (radiance) finish.emplace();
  input.finish_early = [&] { return finish && finish->take_interrupt(); };
  input.hasty = &irradiance;
  const Stopwatch work;
  input.passes = pass_options(a);
  const bake::Baked baked =
      radiance ? bake::bake(input, plan, a.bake.textures,
                            a.bake.lightmap ? bake::Output::lightmap : bake::Output::radiance,
                            a.bake.hdr || a.bake.lightmap ? write_page : bake::PageSink(), console)
               : bake::bake_store(input, irradiance, plan, a.bake.textures, a.bake.store, console);
  const double seconds = work.seconds();
  tell(baked.stats, plan, console);
  if (radiance) console.remark(fmt::format("exposure: {:.2f} EV", bright.exposure_ev));
  write_baked(a, baked);
  if (!a.stats.empty()) write_stats(a.stats, stats_of(a, scene, world, plan, baked.stats, seconds));
}

}  // namespace penumbra::app
