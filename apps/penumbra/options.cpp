#include "options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "bake_options.h"
#include "base/error.h"
#include "compare_options.h"
#include "light_spec.h"
#include "values.h"

namespace penumbra::app {
namespace {

using Names = std::span<const std::string_view>;
// In the order of ShadowKind.
constexpr std::array<std::string_view, 8> kShadows{
    "none", "hard", "area", "parker", "heckbert-herf", "sdf-classic", "sdf-improved", "sdf-inner"};
constexpr std::array<std::string_view, 4> kVariants{"published", "blog", "abs", "march"};
constexpr std::array<std::string_view, 3> kEntries{"auto", "map", "mainImage"};
constexpr std::array<std::string_view, 3> kProfiles{"cubic", "sine", "linear"};
constexpr std::array<std::string_view, 3> kComposites{"min", "multiply", "add"};
constexpr std::array<std::string_view, 5> kAovs{"visibility", "depth", "normal", "error", "steps"};
constexpr std::array<std::string_view, 3> kDevices{"auto", "cpu", "gl"};
constexpr std::array<std::string_view, 8> kPictureOptions{"--size",     "--camera",       "--spp",
                                                          "--exposure", "--mirror-depth", "--aov",
                                                          "--entry",    "--texel-size"};

// Of compare a list, of render perhaps auto.
void read_shadows(const CLI::App& command, const std::string& text, Arguments& a) {
  if (command.get_name() == "compare") {
    a.compare.methods = read_methods(text);
    return;
  }
  a.choose_method = command.get_name() == "render" && text == "auto";
  if (!a.choose_method)
    a.render.shadows.kind = static_cast<ShadowKind>(parse_choice("--shadows", text, kShadows));
}

std::string help_of_shadows(const CLI::App& command) {
  const std::string names =
      "hard, area (the reference), parker, heckbert-herf, sdf-classic, sdf-improved";
  if (command.get_name() == "compare") return "some of " + names + ", sdf-inner; with commas";
  if (command.get_name() == "render")
    return "none, " + names + ", sdf-inner or auto (the fastest that keeps within --error)";
  return "none, " + names + " or sdf-inner";
}

int read_side(const std::string& text, const std::string& side) {
  const std::string remedy = "write it as --size 960x540";
  if (side.empty() || side.find_first_not_of("0123456789") != side.npos)
    throw InputError(fmt::format("--size: '{}' is not WIDTHxHEIGHT", text), remedy);
  if (side.find_first_not_of('0') == side.npos)
    throw InputError(fmt::format("--size: {} has no pixels", text),
                     "give at least 1x1, as in --size 960x540");
  const std::string digits = side.substr(side.find_first_not_of('0'));
  if (digits.size() > 9)
    throw InputError(fmt::format("--size: {} is beyond any memory", text),
                     "give at most 999999999 a side, and a size that fits");
  return std::stoi(digits);
}

void read_size(const std::string& text, RenderOptions& options) {
  const std::vector<std::string> sides = split(text, 'x');
  if (sides.size() != 2)
    throw InputError(fmt::format("--size: '{}' is not WIDTHxHEIGHT", text),
                     "write it as --size 960x540");
  options.width = read_side(text, sides[0]);
  options.height = read_side(text, sides[1]);
}

AovRequest read_aov(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == text.npos || equals + 1 == text.size())
    throw InputError(fmt::format("--aov: '{}' is not NAME=FILE.exr", text),
                     "write it as --aov depth=depth.exr");
  AovRequest aov{text.substr(0, equals), text.substr(equals + 1)};
  parse_choice("--aov", aov.name, kAovs);
  const bool is_heat_map = aov.name == "steps" && aov.file.ends_with(".png");
  if (!aov.file.ends_with(".exr") && !is_heat_map)
    throw InputError(fmt::format("--aov: {} does not end in .exr", aov.file),
                     fmt::format("write it as --aov {}={}.exr", aov.name, aov.name));
  return aov;
}

Bounds read_bounds(const std::string& text) {
  const std::string remedy =
      "write it as --bounds -1,0,-1,1,2,1: the least x, y, z, then the greatest";
  const std::vector<std::string> parts = split(text, ',');
  double numbers[6];
  for (std::size_t i = 0; i < parts.size() || i < 6; ++i)
    if (parts.size() != 6 || !read_number(parts[i], numbers[i]) || std::abs(numbers[i]) > 1e9)
      throw InputError(fmt::format("--bounds: '{}' is not six numbers of at most 1e9", text),
                       remedy);
  const Bounds box{Vec3(Vec3d(numbers[0], numbers[1], numbers[2])),
                   Vec3(Vec3d(numbers[3], numbers[4], numbers[5]))};
  for (int i = 0; i < 3; ++i)
    if (!(box.lo[i] < box.hi[i]))
      throw InputError(fmt::format("--bounds: {} is empty along {}", text, "xyz"[i]), remedy);
  return box;
}

void want_aov(const std::string& name, RenderOptions& options) {
  if (name == "visibility") options.want_visibility = true;
  if (name == "depth") options.want_depth = true;
  if (name == "normal") options.want_normal = true;
  if (name == "error") options.want_error = true;
  if (name == "steps") options.want_steps = true;
}

Device read_device(const std::string& text) {
  if (text == "rays")
    throw InputError("--device: rays is a device of bake alone", "use " + listed(kDevices));
  return static_cast<Device>(parse_choice("--device", text, kDevices));
}

void add_field_options(CLI::App& command, Arguments& a) {
  ShadowOptions& shadows = a.render.shadows;
  const auto add = [&](const char* name, const char* value, const char* shown, auto read,
                       const char* help) {
    add_value(command, a, name, value, shown, read, help)->group("Shadows");
  };
  add(
      "--mint", "M", "0.01", [&](auto& t) { shadows.mint = parse_number("--mint", t, 1e-6, 1e6); },
      "sdf-*: where the march begins, metres from the point");
  add(
      "--steps", "N", "256",
      [&](auto& t) { shadows.steps = static_cast<int>(parse_integer("--steps", t, 1, 65535)); },
      "sdf-*: at most, of a march");
  add(
      "--k", "K", "", [&](auto& t) { shadows.k = parse_number("--k", t, 1e-6, 1e6); },
      "sdf-*: hardness, instead of the light's size: w = 1/K");
  add(
      "--variant", "NAME", "published",
      [&](auto& t) {
        shadows.variant = static_cast<SdfVariant>(parse_choice("--variant", t, kVariants));
      },
      "published; blog (sdf-classic: ratio after the step); abs (sdf-inner: steps of |h|); march "
      "(hard: "
      "the plain march of sdf-*)");
}

}  // namespace

CLI::Option* add_value(CLI::App& command, Arguments& arguments, const std::string& names,
                       const char* value_name, const char* shown_default,
                       std::function<void(const std::string&)> read, const std::string& help) {
  const std::string name = names.substr(0, names.find(','));
  CLI::Option* option = command.add_option(
      names,
      [&arguments, name, read = std::move(read)](const CLI::results_t& values) {
        arguments.given.push_back(name);
        for (const std::string& value : values) read(value);
        return true;
      },
      help);
  return option->type_name(value_name)->default_str(shown_default)->take_last();
}

bool is_picture_option(const std::string& name) {
  return std::find(kPictureOptions.begin(), kPictureOptions.end(), name) != kPictureOptions.end();
}

void add_shadow_options(CLI::App& command, Arguments& a) {
  ShadowOptions& shadows = a.render.shadows;
  const auto add = [&](const char* name, const char* value, const char* shown, auto read,
                       const char* help) {
    add_value(command, a, name, value, shown, read, help)->group("Shadows");
  };
  add(
      "--shadows", command.get_name() == "compare" ? "A,B,C" : "METHOD",
      command.get_name() == "compare" ? "all" : "parker",
      [&](auto& t) { read_shadows(command, t, a); }, help_of_shadows(command).c_str());
  add(
      "--light-samples", "N", "64, by solid angle",
      [&](auto& t) {
        shadows.light_samples = static_cast<int>(parse_integer("--light-samples", t, 1, 1 << 20));
      },
      "area, heckbert-herf: points on each light");
  add(
      "--error", "X", "", [&](auto& t) { shadows.error = parse_number("--error", t, 1e-4, 1); },
      "area: adaptive, until the standard error of the visible fraction is below X");
  add(
      "--profile", "NAME", "cubic",
      [&](auto& t) {
        shadows.profile = static_cast<Profile>(parse_choice("--profile", t, kProfiles));
      },
      "parker: cubic, sine or linear penumbra");
  add(
      "--composite", "NAME", "min",
      [&](auto& t) {
        shadows.composite = static_cast<Composite>(parse_choice("--composite", t, kComposites));
      },
      "parker: min, multiply or add the shadows of objects");
  add(
      "--tolerance", "X", "0.02",
      [&](auto& t) { shadows.tolerance = parse_number("--tolerance", t, 0, 1); },
      "parker: allowed change of the visible fraction, 0 = exact");
  add(
      "--texel-size", "METRES", "4 million texels",
      [&](auto& t) { a.bake.textures.texel_size = parse_number("--texel-size", t, 1e-6, 1e6); },
      "heckbert-herf: side of a texel of what is baked first");
  add(
      "--sample-grid", "NAME", "jittered",
      [&](auto& t) { a.bake.light.placement = read_sample_grid(t); },
      "heckbert-herf: jittered, regular or low-discrepancy points on each light");
  add_field_options(command, a);
}

void add_light_options(CLI::App& command, Arguments& a) {
  add_value(
      command, a, "--light", "SPEC", "", [&](auto& t) { a.lights.push_back(parse_light(t)); },
      "add a light; repeatable. Three numbers a point or direction, emission one or three:\n"
      "sphere:position,radius,radiance  disk:position,normal,radius,radiance\n"
      "rect:corner,edge_u,edge_v,radiance  segment:from,to,radius,radiance\n"
      "point:position,intensity  sun:direction,angular_diameter_deg,irradiance")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->group("Lights");
  command
      .add_flag_callback(
          "--no-scene-lights", [&a] { a.keep_scene_lights = false; }, "leave out the file's lights")
      ->group("Lights");
  add_value(
      command, a, "--light-factor", "LIGHT=R,G,B", "",
      [&](auto& t) { a.light_factors.push_back(parse_light_factor(t)); },
      "multiply the emission of a light, by its name or index; one number or three; repeatable")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->group("Lights");
  add_value(
      command, a, "--light-size", "F", "1",
      [&](auto& t) { a.light_size = parse_number("--light-size", t, 1e-6, 1e6); },
      "scale all lights about their centres")
      ->group("Lights");
}

void add_picture_options(CLI::App& command, Arguments& a) {
  RenderOptions& render = a.render;
  const auto add = [&](const char* name, const char* value, const char* shown, auto read,
                       const char* help) {
    return add_value(command, a, name, value, shown, read, help)->group("Picture");
  };
  add(
      "--size", "WxH", "960x540", [&](auto& t) { read_size(t, render); }, "pixels");
  add(
      "--camera", "NAME|INDEX", "0", [&](auto& t) { a.camera = t; }, "which of the scene's");
  add(
      "--spp", "N", "4",
      [&](auto& t) { render.spp = static_cast<int>(parse_integer("--spp", t, 1, 65536)); },
      "samples per pixel");
  add(
      "--exposure", "EV|auto", "auto",
      [&](auto& t) {
        render.exposure_ev.reset();
        if (t != "auto") render.exposure_ev = parse_number("--exposure", t, -100, 100);
      },
      "stops of the PNG; auto chooses from the scene");
  add(
      "--mirror-depth", "N", "5",
      [&](auto& t) {
        render.mirror_depth = static_cast<int>(parse_integer("--mirror-depth", t, 0, 64));
      },
      "reflections followed");
  add(
      "--aov", "NAME=FILE.exr", "",
      [&](auto& t) {
        a.aovs.push_back(read_aov(t));
        want_aov(a.aovs.back().name, render);
      },
      "also write visibility, depth, normal, error or steps; repeatable. steps=FILE.png is a heat\n"
      "map: black 1 or none, indigo 4, teal 16, yellow 64, white 256 or more samples of the "
      "marches")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  add(
      "--device", "NAME", "auto", [&](auto& t) { a.device = read_device(t); },
      "cpu, gl (OpenGL, by distances) or auto: gl for .glsl, cpu for the rest");
  add(
      "--time", "T", "0", [&](auto& t) { a.render.time = parse_number("--time", t, -1e9, 1e9); },
      "seconds: the moment of what moves, iTime of shaders");
  add(
      "--entry", "NAME", "auto",
      [&](auto& t) { a.entry = static_cast<Entry>(parse_choice("--entry", t, kEntries)); },
      "of shaders: map, mainImage or auto, which takes mainImage if there is one");
}

void add_run_options(CLI::App& command, Arguments& a) {
  const auto add = [&](const char* name, const char* value, const char* shown, auto read,
                       const char* help) {
    add_value(command, a, name, value, shown, read, help)->group("Run");
  };
  add(
      "--seed", "N", "0",
      [&](auto& t) {
        constexpr std::int64_t most = std::numeric_limits<std::uint32_t>::max();
        a.render.seed = static_cast<std::uint32_t>(parse_integer("--seed", t, 0, most));
        a.render.shadows.seed = a.render.seed;
      },
      "of all sampling; the same seed gives the same bytes");
  add(
      "--threads", "N", "all",
      [&](auto& t) { a.threads = static_cast<int>(parse_integer("--threads", t, 1, 1024)); },
      "how many work");
  add(
      "--stats", "FILE.json", "", [&](auto& t) { a.stats = t; },
      "write counts, seconds and memory");
  command.add_flag("-q,--quiet", a.quiet, "say nothing but errors")->group("Run");
}

void add_animation_options(CLI::App& command, Arguments& a) {
  const auto add = [&](const char* name, const char* value, const char* shown, auto read,
                       const char* help) {
    add_value(command, a, name, value, shown, read, help)->group("Film");
  };
  add(
      "--frames", "N", "to the last keyframe",
      [&](auto& t) {
        a.animation.frames = static_cast<int>(parse_integer("--frames", t, 1, 1'000'000));
      },
      "how many; shaders and turntables go on for 4 s without it");
  add(
      "--fps", "F", "24",
      [&](auto& t) { a.animation.frames_per_second = parse_number("--fps", t, 1e-3, 1e4); },
      "frames a second; the first shows --time");
  add(
      "--turntable", "DEGREES", "0",
      [&](auto& t) { a.animation.turntable = parse_number("--turntable", t, -1e6, 1e6); },
      "how far the camera goes round the scene; 360 comes back to the first frame");
  command.add_flag("--resume", a.animation.resume, "keep frames that are there already")
      ->group("Film");
}

void add_conversion_options(CLI::App& command, Arguments& a) {
  const auto add = [&](const char* name, const char* value, const char* shown, auto read,
                       const char* help) {
    add_value(command, a, name, value, shown, read, help)->group("Distance fields");
  };
  add(
      "--voxel-size", "METRES", "1/128 of the size",
      [&](auto& t) { a.conversion.voxel_size = parse_number("--voxel-size", t, 1e-9, 1e9); },
      "of the grids between meshes and distance fields");
  add(
      "--bounds", "X0,Y0,Z0,X1,Y1,Z1", "", [&](auto& t) { a.conversion.bounds = read_bounds(t); },
      "what of a distance field becomes triangles");
}

}  // namespace penumbra::app
