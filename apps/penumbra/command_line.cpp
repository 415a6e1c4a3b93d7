#include "command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bake_options.h"
#include "base/error.h"
#include "base/nearest_name.h"
#include "options.h"
#include "values.h"

namespace penumbra::app {
namespace {

// In the order of Command.
constexpr std::array<std::string_view, 8> kCommands{"render", "probe", "info", "new",
                                                    "export", "bake",  "diff", "animate"};
constexpr std::array<std::string_view, 2> kLaterCommands{"view", "compare"};
constexpr const char* kScenes = "scene: .json, .gltf, .glb, .obj, .ply, .ply.gz, .stl or .glsl";

bool contains(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void add_file(CLI::App& command, const char* name, std::string& file, const char* help) {
  command.add_option(name, file, help)->type_name("")->group("Files");
}

void add_output(CLI::App& command, Arguments& a, const char* value, const char* help) {
  add_value(
      command, a, "-o,--output", value, "", [&a](auto& t) { a.output = t; }, help)
      ->group("Files");
}

void add_render(CLI::App& app, Arguments& a) {
  CLI::App& command = *app.add_subcommand("render", "Make a picture of a scene");
  add_file(command, "SCENE", a.scene, kScenes);
  add_output(command, a, "OUT", ".png (sRGB) or .exr (linear, with layers)");
  add_shadow_options(command, a);
  add_light_options(command, a);
  add_picture_options(command, a);
  add_conversion_options(command, a);
  add_run_options(command, a);
}

void add_probe(CLI::App& app, Arguments& a) {
  CLI::App& command = *app.add_subcommand("probe", "Tell what fraction of a light points can see");
  add_file(command, "SCENE", a.scene, kScenes);
  add_value(
      command, a, "--points", "IN.csv", "", [&a](auto& t) { a.points = t; },
      "points: a header with x,y,z,nx,ny,nz and perhaps light (index; 0 if absent)")
      ->group("Files");
  add_output(command, a, "OUT.csv", "the same rows with visible_fraction (default: stdout)");
  add_shadow_options(command, a);
  add_light_options(command, a);
  add_picture_options(command, a);
  add_conversion_options(command, a);
  // So that a script may pass both commands the same options; they do nothing here.
  for (CLI::Option* option : command.get_options())
    if (is_picture_option(option->get_name())) option->group("");
  add_run_options(command, a);
}

void add_bake(CLI::App& app, Arguments& a) {
  CLI::App& command = *app.add_subcommand("bake", "Bake light and shadows into a glTF file");
  add_file(command, "SCENE", a.scene, kScenes);
  add_output(command, a, "OUT.glb", "unlit surfaces with textures of radiance");
  add_bake_options(command, a);
  add_light_options(command, a);
  add_conversion_options(command, a);
  add_run_options(command, a);
}

void add_export(CLI::App& app, Arguments& a) {
  CLI::App& command =
      *app.add_subcommand("export", "Write a distance-field scene as a shader for Shadertoy");
  add_file(command, "SCENE", a.scene, kScenes);
  add_output(command, a, "OUT.glsl", "a shader with mainImage");
  add_shadow_options(command, a);
  add_light_options(command, a);
  add_picture_options(command, a);
  add_run_options(command, a);
}

void add_diff(CLI::App& app, Arguments& a) {
  CLI::App& command = *app.add_subcommand("diff", "Tell how far apart two pictures are");
  add_file(command, "A", a.diff.reference, "reference: .png or .exr");
  add_file(command, "B", a.diff.test, "what to compare with it: of the same kind and size");
  add_diff_options(command, a);
  command.footer("Exit status: 0 within the limits, 1 beyond, 2 trouble.");
}

void add_animate(CLI::App& app, Arguments& a) {
  CLI::App& command = *app.add_subcommand("animate", "Draw the frames of a scene that moves");
  add_file(command, "SCENE", a.scene, kScenes);
  add_output(command, a, "OUT", "frames/%04d.png (or .exr), or a film: .mp4 .mov .mkv .webm .gif");
  add_animation_options(command, a);
  add_shadow_options(command, a);
  add_light_options(command, a);
  add_picture_options(command, a);
  add_conversion_options(command, a);
  add_run_options(command, a);
}

void add_info(CLI::App& app, Arguments& a) {
  CLI::App& command = *app.add_subcommand("info", "Tell what was understood of a scene");
  add_file(command, "SCENE", a.scene, kScenes);
  add_conversion_options(command, a);
}

void add_new(CLI::App& app, Arguments& a) {
  CLI::App& command = *app.add_subcommand("new", "Write a commented scene to begin from");
  add_file(command, "NAME.json", a.scene, "file to write; it must not be there yet");
  command.add_flag("--schema", a.schema, "write the JSON Schema of scene files instead");
}

void build(CLI::App& app, Arguments& a) {
  app.set_version_flag("--version", "penumbra " PENUMBRA_VERSION, "Print the version and end");
  app.set_help_flag("-h,--help", "Print this help and end");
  app.require_subcommand(0, 1);
  add_render(app, a);
  add_probe(app, a);
  add_bake(app, a);
  add_animate(app, a);
  add_export(app, a);
  add_diff(app, a);
  add_info(app, a);
  add_new(app, a);
  app.footer(
      "penumbra COMMAND --help tells a command's options. For example:\n"
      "  penumbra render kitchen.glb -o kitchen.png --shadows parker\n"
      "  penumbra probe room.json --points in.csv -o out.csv --shadows area");
  for (CLI::App* command : app.get_subcommands({})) command->allow_extras();
  app.allow_extras();
}

[[noreturn]] void refuse_command(const std::string& name) {
  if (contains(kLaterCommands, name))
    throw InputError(fmt::format("{} is not in this version", name), "use " + listed(kCommands));
  if (name.starts_with('-'))
    throw InputError(fmt::format("{} is no option here", name),
                     "begin with a command, as in penumbra render SCENE -o OUT.png");
  throw InputError(fmt::format("'{}' is no command", name),
                   fmt::format("did you mean {}? There are {}", nearest_name(name, kCommands),
                               listed(kCommands)));
}

std::vector<std::string> long_options(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

[[noreturn]] void refuse_option(const CLI::App& command, const std::string& argument) {
  const std::string name = argument.substr(0, argument.find('='));
  if (!name.starts_with('-'))
    throw InputError(fmt::format("'{}' is one file too many", argument),
                     fmt::format("see penumbra {} --help", command.get_name()));
  const std::vector<std::string> names = long_options(command);
  const std::vector<std::string_view> views(names.begin(), names.end());
  throw InputError(fmt::format("{} is no option of {}", name, command.get_name()),
                   fmt::format("did you mean {}?", nearest_name(name, views)));
}

// CLI11's complaints that are left: a value is missing, or a flag has one.
InputError reworded(const CLI::ParseError& error) {
  const std::string text = error.what();
  const std::string option = text.substr(0, text.find(':'));
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr && option.starts_with('-'))
    return {option + ": its value is missing", "give one; see --help"};
  return {text, "see --help"};
}

void check_complete(Arguments& a) {
  if (a.command == Command::diff) {
    if (a.diff.test.empty())
      throw InputError(
          a.diff.reference.empty() ? "no pictures are named" : "one picture is missing",
          "write penumbra diff A B");
    return;
  }
  if (a.scene.empty())
    throw InputError(
        a.command == Command::make_new ? "no file is named" : "no scene is named",
        fmt::format("write penumbra {} {}", kCommands[static_cast<std::size_t>(a.command)],
                    a.command == Command::make_new ? "NAME.json" : "SCENE"));
  if (a.command == Command::render && a.output.empty())
    throw InputError("no output is named", "add -o OUT.png or -o OUT.exr");
  if (a.command == Command::animate && a.output.empty())
    throw InputError("no output is named", "add -o frames/%04d.png or -o film.mp4");
  if (a.command == Command::bake && a.output.empty())
    throw InputError("no output is named", "add -o OUT.glb");
  if (a.command == Command::export_shader && a.output.empty())
    throw InputError("no output is named", "add -o OUT.glsl");
  if (a.command == Command::probe && a.points.empty())
    throw InputError("no points are named", "add --points IN.csv");
}

void parse(CLI::App& app, int argc, const char* const* argv, Arguments& a) {
  app.parse(argc, argv);
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  if (chosen.empty() && app.remaining().empty())
    throw InputError("no command is given",
                     fmt::format("use {}; see penumbra --help", listed(kCommands)));
  if (chosen.empty() || !app.remaining().empty()) refuse_command(app.remaining().front());
  const CLI::App& command = *chosen.front();
  if (!command.remaining().empty()) refuse_option(command, command.remaining().front());
  const auto found = std::find(kCommands.begin(), kCommands.end(), command.get_name());
  a.command = static_cast<Command>(found - kCommands.begin());
  check_complete(a);
}

}  // namespace

std::optional<Arguments> parse_command_line(int argc, const char* const* argv,
                                            std::string& answer) {
  Arguments arguments;
  arguments.command_line.assign(argv, argv + argc);
  CLI::App app("Soft shadows in pictures of 3D models, measured against the truth.", "penumbra");
  build(app, arguments);
  try {
    parse(app, argc, argv, arguments);
  } catch (const CLI::CallForHelp&) {
    answer = app.help();
    return std::nullopt;
  } catch (const CLI::CallForVersion& version) {
    answer = std::string(version.what()) + '\n';
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    throw reworded(error);
  }
  return arguments;
}

}  // namespace penumbra::app
