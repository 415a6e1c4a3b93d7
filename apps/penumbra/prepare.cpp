#include "prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/error.h"
#include "base/nearest_name.h"
#include "light_factor.h"
#include "light_spec.h"
#include "options.h"
#include "scene/extent.h"
#include "scene/finish.h"
#include "scene/load.h"
#include "scene/sdf_path.h"

namespace penumbra::app {
namespace {

// With what an option does nothing in this call; empty if it does something.
std::string_view idle_with(const std::string& option, const Arguments& a) {
  constexpr std::string_view method = "with this method";
  if (a.command == Command::probe && is_picture_option(option)) return "on probe";
  if (a.command == Command::compare &&
      (option == "--aov" || option == "--entry" || option == "--time"))
    return "on compare";
  const ShadowOptions& shadows = a.render.shadows;
  const bool baked = shadows.kind == ShadowKind::heckbert_herf;
  const bool of_area = option == "--light-samples" || option == "--error";
  const bool of_parker =
      option == "--profile" || option == "--composite" || option == "--tolerance";
  const bool of_fields = option == "--mint" || option == "--steps" || option == "--k";
  if (of_fields && !shadows.marches_field()) return method;
  if (option == "--k" && shadows.kind == ShadowKind::hard) return method;
  if (option == "--light-samples" && baked) return {};
  const bool of_bakes = option == "--texel-size" || option == "--sample-grid";
  if (of_bakes && !baked) return method;
  if (option == "--error" && a.choose_method) return {};
  if (of_area && shadows.kind != ShadowKind::area) return method;
  if (of_parker && shadows.kind != ShadowKind::parker) return method;
  if (option == "--light-samples" && shadows.error) return "beside --error";
  if (option == "--tolerance" && shadows.composite != Composite::min)
    return "with this --composite";
  return {};
}

// With none of the methods.
std::string_view idle_with_all(const std::string& option, const Arguments& a) {
  if (a.command != Command::compare) return idle_with(option, a);
  std::string_view idle;
  for (const ShadowKind kind : a.compare.methods) {
    Arguments one = a;
    one.render.shadows.kind = kind;
    idle = idle_with(option, one);
    if (idle.empty()) return {};
  }
  return idle == "with this method" ? "with these methods" : idle;
}

// Each variant belongs to one method.
void check_variant(const Arguments& a) {
  const ShadowKind kind = a.render.shadows.kind;
  const SdfVariant variant = a.render.shadows.variant;
  if (variant == SdfVariant::blog && kind != ShadowKind::sdf_classic)
    throw InputError("--variant: blog is a variant of sdf-classic", "add --shadows sdf-classic");
  if (variant == SdfVariant::abs && kind != ShadowKind::sdf_inner)
    throw InputError("--variant: abs is a variant of sdf-inner", "add --shadows sdf-inner");
  if (variant == SdfVariant::march && kind != ShadowKind::hard)
    throw InputError("--variant: march is a variant of hard", "add --shadows hard");
}

// A scene without lights is wanted as it is if its own were dropped on purpose: a stand-in keeps
// the key light away.
void add_what_is_missing(Scene& scene, bool want_light) {
  if (!want_light) scene.lights.emplace_back();
  add_missing_camera_and_light(scene);
  if (!want_light) scene.lights.pop_back();
}

void repeat_report(const LoadReport& report, Console& console) {
  for (const std::string& text : report.conversions) console.remark(text);
  for (const std::string& text : report.warnings) console.warn(text);
}

std::string camera_remedy(const Scene& scene, const std::string& name) {
  std::vector<std::string_view> names;
  for (const Camera& camera : scene.cameras)
    if (!camera.name.empty()) names.push_back(camera.name);
  const std::string indices =
      scene.cameras.size() == 1 ? "0" : fmt::format("0 to {}", scene.cameras.size() - 1);
  if (names.empty()) return fmt::format("give an index, {}", indices);
  return fmt::format("did you mean '{}'? An index, {}, will do too", nearest_name(name, names),
                     indices);
}

void refuse_without_end(const Scene& scene, const std::string& file) {
  for (const SdfTree& tree : scene.sdfs)
    if (const auto node = unbounded_node(tree))
      throw InputError({file},
                       fmt::format("the {} at {} of \"{}\" has no end, and this method needs "
                                   "triangles of it",
                                   signature_of(tree.nodes[*node].op).name, sdf_path(tree, *node),
                                   scene.objects[tree.object].name),
                       "give the box to keep by --bounds x0,y0,z0,x1,y1,z1");
}

}  // namespace

void warn_of_idle_options(const Arguments& arguments, Console& console) {
  if (arguments.command != Command::compare && !arguments.choose_method) check_variant(arguments);
  for (const std::string& option : arguments.given)
    if (const auto with = idle_with_all(option, arguments); !with.empty())
      console.warn(fmt::format("{} has no effect {}", option, with));
}

Scene prepare_scene(const Arguments& arguments, Console& console) {
  console.start("load", 0);
  Scene scene = load_scene(arguments.scene,
                           {.add_missing_camera_and_light = false, .time = arguments.render.time});
  if (!arguments.keep_scene_lights) drop_lights(scene);
  scene.lights.insert(scene.lights.end(), arguments.lights.begin(), arguments.lights.end());
  add_what_is_missing(scene, arguments.keep_scene_lights && scene.lights.empty());
  const std::vector<std::string> warnings = arguments.light_size == 1
                                                ? std::vector<std::string>{}
                                                : scale_lights(scene, arguments.light_size);
  for (const LightFactor& factor : arguments.light_factors) apply(factor, scene);
  console.finish();
  repeat_report(scene.report, console);
  for (const std::string& text : warnings) console.warn(text);
  return scene;
}

int chosen_camera(const Scene& scene, const std::string& name_or_index) {
  if (scene.cameras.empty())
    throw InputError("the scene has no camera, and nothing to aim one at",
                     "give it objects or a \"camera\"");
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    if (scene.cameras[i].name == name_or_index) return static_cast<int>(i);
  std::size_t index = 0;
  const char* end = name_or_index.data() + name_or_index.size();
  const auto [stop, error] = std::from_chars(name_or_index.data(), end, index);
  if (error == std::errc() && stop == end && index < scene.cameras.size())
    return static_cast<int>(index);
  throw InputError(fmt::format("--camera: the scene has no camera '{}'", name_or_index),
                   camera_remedy(scene, name_or_index));
}

std::unique_ptr<World> build_world(const Scene& scene, const Arguments& arguments,
                                   Console& console) {
  const ShadowKind kind = arguments.render.shadows.kind;
  if (kind == ShadowKind::parker && !arguments.conversion.bounds)
    refuse_without_end(scene, arguments.scene);
  console.start("build", 0);
  WorldOptions options;
  options.cone_tree =
      kind == ShadowKind::parker || (kind == ShadowKind::area && scene.sdfs.empty());
  options.field = arguments.render.shadows.marches_field();
  options.conversions = arguments.conversion;
  auto world = std::make_unique<World>(scene, options);
  console.finish();
  return world;
}

}  // namespace penumbra::app
