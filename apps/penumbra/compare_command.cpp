#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "commands.h"
#include "drawers.h"
#include "memory.h"
#include "prepare.h"
#include "render_words.h"
#include "report/comparison.h"
#include "report/digest.h"
#include "report/folder.h"
#include "report/reference_file.h"
#include "report/table.h"
#include "stats.h"

namespace penumbra::app {
namespace {

void check_scene(const Arguments& a, const Scene& scene) {
  if (scene.glsl)
    throw InputError({a.scene}, "a shader's scene cannot be compared: only OpenGL shows it",
                     "write the scene as distance-field objects (\"type\": \"sdf\")");
  if (scene.lights.empty())
    throw InputError({a.scene}, "the scene has no light, so there is no shadow to compare",
                     "add one with --light");
}

// All pictures and visible fractions are in memory at a time.
void check_fits(const Arguments& a, const Scene& scene) {
  Arguments all = a;
  all.render.want_visibility = true;
  check_picture_fits(all, (scene.lights.size() + 6) * (a.compare.methods.size() + 2));
}

report::ReferenceOptions reference_options(const Arguments& a) {
  report::ReferenceOptions options;
  options.width = a.render.width, options.height = a.render.height;
  options.camera = a.render.camera, options.seed = a.render.seed;
  return options;
}

// From the folder, as far as it is there, else by work.
void find_reference(const Arguments& a, const Scene& scene, const World& world,
                    report::Comparison& c, Console& console) {
  const std::string file = report::reference_file(a.output);
  const RenderOptions picture = reference_picture(a);
  const std::uint64_t key = report::reference_key(scene, c.reference_options, picture);
  const report::FileState state = load_reference(file, key, c.reference);
  if (state == report::FileState::damaged)
    console.warn(fmt::format("{}: the kept reference is damaged; it is made again", file));
  if (const auto done = std::count(c.reference.tiles.begin(), c.reference.tiles.end(), 1);
      done > 0 && !c.reference.complete())
    console.remark(fmt::format("the reference goes on where it was stopped, {} % done",
                               100 * static_cast<std::size_t>(done) / c.reference.tiles.size()));
  c.reference_was_cached = c.reference.complete();
  if (c.reference_was_cached) return;
  const auto save = [&](const report::Reference& r) { save_reference(file, key, r); };
  if (std::find(c.reference.tiles.begin(), c.reference.tiles.end(), 0) != c.reference.tiles.end())
    complete_reference(world, c.reference_options, c.reference, save, console);
  if (std::find(c.reference.surface.begin(), c.reference.surface.end(), 1) ==
      c.reference.surface.end())
    throw InputError({a.scene}, "the camera sees no surface, so there is nothing to compare",
                     "choose another with --camera");
  save(c.reference);
  const Stopwatch watch;
  RenderResult drawn = render(world, picture, console);
  c.reference.color = std::move(drawn.color);
  c.reference.exposure_ev = drawn.stats.exposure_ev;
  c.reference.seconds += watch.seconds();
  save(c.reference);
}

std::vector<report::MethodCall> calls_of(const Arguments& a, const Scene& scene) {
  std::vector<report::MethodCall> calls;
  for (const ShadowKind kind : a.compare.methods) {
    report::MethodCall call{report::method_of(kind), options_for(kind, a), "", {}};
    call.command = render_words(a, call.text.name);
    call.conversions = conversions_for(scene, a, kind);
    calls.push_back(std::move(call));
  }
  return calls;
}

void describe_scene(const Arguments& a, const Scene& scene, report::Comparison& c) {
  const Camera& camera = scene.cameras[static_cast<std::size_t>(a.render.camera)];
  c.scene_file = std::filesystem::path(a.scene).filename().string();
  c.checksum = report::digest_of(scene);
  c.camera = camera.name.empty() ? std::to_string(a.render.camera) : camera.name;
  c.command = all_words(a);
  c.lights = scene.lights;
  c.objects = scene.objects.size();
  for (const Instance& instance : scene.instances)
    c.triangles += scene.meshes[instance.mesh].triangle_count();
  c.machine = report::this_machine();
  c.versions = report::versions();
}

void run_sweeps(const Arguments& a, const Scene& scene, report::Comparison& c, Console& console) {
  std::vector<report::SweepMethodCall> methods;
  for (const report::MethodResult& m : c.methods)
    if (m.ok()) methods.push_back({std::string(m.call.text.name), m.call.options});
  for (const report::SweepRequest& request : a.compare.sweeps)
    c.sweeps.push_back(report::sweep(scene, change_lights(scene), request, methods, drawers_for(a),
                                     a.compare.repeats.value_or(1), console));
}

void take_all_methods(Arguments& a) {
  if (!a.compare.methods.empty()) return;
  for (const report::MethodText& method : report::methods())
    a.compare.methods.push_back(method.kind);
}

}  // namespace

void run_compare(Arguments& a, Console& console) {
  take_all_methods(a);
  RenderOptions& o = a.render;
  o.want_visibility = o.want_depth = o.want_normal = o.want_error = o.want_steps = false;
  check_picture_fits(a, a.lights.size());
  warn_of_idle_options(a, console);
  const Stopwatch load;
  const Scene scene = prepare_scene(a, console);
  const double load_seconds = load.seconds();
  check_scene(a, scene);
  a.render.camera = chosen_camera(scene, a.camera);
  check_fits(a, scene);
  report::prepare_folder(a.output);

  report::Comparison c;
  describe_scene(a, scene, c);
  c.reference_options = reference_options(a);
  c.reference = report::empty_reference(c.reference_options, scene.lights.size());
  const std::unique_ptr<World> world = reference_world(scene);
  find_reference(a, scene, *world, c, console);
  c.exposure_ev = a.render.exposure_ev.value_or(c.reference.exposure_ev);
  const Stopwatch comparing;
  const double limit = a.render.shadows.error ? *a.render.shadows.error : report::default_limit;
  compare_methods(scene, *world, calls_of(a, scene), drawers_for(a), a.compare.repeats, limit, c,
                  console);
  run_sweeps(a, scene, c, console);
  const double compare_seconds = comparing.seconds();
  console.start("write", 0);
  write_folder(a.output, c);
  console.finish();
  if (!a.quiet) print(table_text(c));
  if (a.stats.empty()) return;
  Json::Value stats = common_stats(a, scene, world->memory_bytes());
  stats["seconds"]["load"] = load_seconds;
  stats["seconds"]["reference"] = c.reference.seconds;
  stats["seconds"]["compare"] = compare_seconds;
  write_stats(a.stats, stats);
}

}  // namespace penumbra::app
