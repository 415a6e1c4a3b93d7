#include "bake_options.h"

#include <array>

#include "base/error.h"
#include "options.h"
#include "values.h"

namespace penumbra::app {
namespace {

constexpr std::array<std::string_view, 4> kDevices{"auto", "cpu", "gl", "rays"};
// In the order of Store and of SamplePlacement.
constexpr std::array<std::string_view, 3> kStores{"radiance", "visibility", "samples"};
constexpr std::array<std::string_view, 3> kSampleGrids{"jittered", "regular", "low-discrepancy"};
// In the order of CurvedShadows.
constexpr std::array<std::string_view, 2> kCurved{"rays", "plane"};
constexpr std::array<std::string_view, 2> kLayouts{"unwrap", "existing"};

bake::BakeDevice read_device(const std::string& text) {
  return static_cast<bake::BakeDevice>(parse_choice("--device", text, kDevices));
}

void add_light_choices(CLI::App& command, Arguments& a) {
  bake::BakeOptions& light = a.bake.light;
  const auto add = [&](const char* name, const char* value, const char* shown, auto read,
                       const char* help) {
    add_value(command, a, name, value, shown, read, help)->group("Light");
  };
  add(
      "--device", "NAME", "auto", [&](auto& t) { light.device = read_device(t); },
      "cpu (rasteriser), gl (OpenGL), rays, or auto: the cheaper one for each chart");
  add(
      "--curved", "NAME", "rays",
      [&](auto& t) {
        light.curved = static_cast<bake::CurvedShadows>(parse_choice("--curved", t, kCurved));
      },
      "rays, or plane: curved surfaces are shadowed on a plane and projected; no self-shadows");
  add(
      "--light-samples", "N", "by solid angle",
      [&](auto& t) {
        light.light_samples = static_cast<int>(parse_integer("--light-samples", t, 1, 1 << 16));
      },
      "points on each light");
  add(
      "--light-samples-scale", "F", "1",
      [&](auto& t) { light.samples_scale = parse_number("--light-samples-scale", t, 1e-3, 1e3); },
      "multiplies the points on all lights");
  add(
      "--sample-grid", "NAME", "jittered", [&](auto& t) { light.placement = read_sample_grid(t); },
      "jittered, regular or low-discrepancy points on each light");
  add(
      "--error", "X", "", [&](auto& t) { a.bake.error = parse_number("--error", t, 1e-4, 1); },
      "stop each chart when the standard error of its irradiance, by two independent halves of "
      "its points, is below X of its brightest; 16 points at least");
  add(
      "--time-limit", "SECONDS", "",
      [&](auto& t) { a.bake.time_limit = parse_number("--time-limit", t, 1e-3, 1e7); },
      "of lighting, in passes of 1, 4, 16 ... points a light; the first is always finished");
}

void add_texture_options(CLI::App& command, Arguments& a) {
  bake::TextureOptions& textures = a.bake.textures;
  const auto add = [&](const char* name, const char* value, const char* shown, auto read,
                       const char* help) {
    return add_value(command, a, name, value, shown, read, help)->group("Textures");
  };
  add(
      "--texel-size", "METRES", "4 million texels",
      [&](auto& t) { textures.texel_size = parse_number("--texel-size", t, 1e-6, 1e6); },
      "side of a texel; finer where a base-colour texture is");
  add(
      "--uv", "NAME", "unwrap",
      [&](auto& t) { textures.existing_uv = parse_choice("--uv", t, kLayouts) == 1; },
      "unwrap, or existing: a texture an object, laid out by its TEXCOORD_1, else TEXCOORD_0");
  add(
      "--supersample", "N", "1",
      [&](auto& t) {
        textures.supersample = static_cast<int>(parse_integer("--supersample", t, 1, 8));
      },
      "N x N points a texel");
  command
      .add_flag_callback(
          "--power-of-two", [&a] { a.bake.textures.power_of_two = true; },
          "sides of textures are powers of two")
      ->group("Textures");
  add(
      "--receivers", "NAME", "all", [&](auto& t) { textures.receivers.push_back(t); },
      "an object to bake; repeatable; the others are lit at their vertices")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  add(
      "--max-memory", "MB", "half of what is free",
      [&](auto& t) {
        textures.most_bytes =
            static_cast<std::uint64_t>(parse_integer("--max-memory", t, 1, 1 << 30)) * 1'000'000;
      },
      "for texels, at most");
}

void add_file_options(CLI::App& command, Arguments& a) {
  const auto flag = [&](const char* name, bool& value, const char* help) {
    command
        .add_flag_callback(
            name, [&value] { value = true; }, help)
        ->group("Files");
  };
  flag("--lightmap", a.bake.lightmap,
       "keep the materials and add irradiance (MOZ_lightmap, EXR and JSON beside)");
  add_value(
      command, a, "--store", "WHAT", "radiance",
      [&a](auto& t) {
        a.bake.store = static_cast<bake::Store>(parse_choice("--store", t, kStores));
      },
      "radiance; visibility (a texture of visible fractions for each light) or samples (one bit a "
      "texel and light point), which penumbra render lights and shades")
      ->group("Files");
  flag("--hdr", a.bake.hdr, "also write linear radiance as EXR beside the .glb");
  add_value(
      command, a, "--preview", "FILE.html", "", [&a](auto& t) { a.bake.preview = t; },
      "also write a page that shows the result, viewer inside")
      ->group("Files");
  add_value(
      command, a, "--exposure", "EV|auto", "auto",
      [&a](auto& t) {
        a.render.exposure_ev.reset();
        if (t != "auto") a.render.exposure_ev = parse_number("--exposure", t, -100, 100);
      },
      "stops of 8-bit textures; auto as render chooses")
      ->group("Textures");
  add_value(
      command, a, "--camera", "NAME|INDEX", "0", [&a](auto& t) { a.camera = t; },
      "whose view auto looks at")
      ->group("Textures");
}

}  // namespace

bake::SamplePlacement read_sample_grid(const std::string& text) {
  return static_cast<bake::SamplePlacement>(parse_choice("--sample-grid", text, kSampleGrids));
}

void add_bake_options(CLI::App& command, Arguments& a) {
  add_light_choices(command, a);
  add_texture_options(command, a);
  add_file_options(command, a);
}

}  // namespace penumbra::app
