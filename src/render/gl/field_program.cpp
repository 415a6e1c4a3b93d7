#include "render/gl/field_program.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "render/glsl/mask_text.h"
#include "sdf/glsl/generate.h"

namespace penumbra {
namespace {

constexpr int kEmptyUnit = 7;  // no texture is ever bound there
constexpr int kMeshUnit = 5, kLightUnit = 6, kImageUnit = 8, kMaskUnit = 9;

[[noreturn]] void refuse(const gl::CompileError& error, const FieldText& field) {
  const auto& messages = error.messages();
  const auto in = [&](bool theirs) {
    return std::find_if(messages.begin(), messages.end(), [&](const gl::CompileMessage& m) {
      return m.error && (m.line < first_line_of_ours) == theirs;
    });
  };
  const std::string log = error.what();
  const std::string first_line = log.substr(0, log.find('\n'));
  if (!field.user)
    throw WorkError("the OpenGL driver refuses the generated shader: " + first_line,
                    "use another driver or --device cpu");
  if (const auto m = in(true); m != messages.end()) {
    Place place{field.user->file, static_cast<std::uint64_t>(m->line)};
    if (m->column > 0) place.column = static_cast<std::uint64_t>(m->column);
    throw InputError(place, m->text, "correct the shader; it is read as GLSL ES 3.00");
  }
  const auto ours = in(false);
  throw InputError({field.user->file}, ours != messages.end() ? ours->text : first_line,
                   "let it have float map(vec3 p), vec3 albedo(vec3 p) or void mainImage(out vec4 "
                   "color, in vec2 pixel) with just these parameters");
}

void set_view(gl::Program& program, const ShaderView& view) {
  const auto width = static_cast<float>(view.width), height = static_cast<float>(view.height);
  program.set("pnb_size", width, height);
  program.set("pnb_zero", 0);
  program.set("iResolution", width, height, 1.0f);
  program.set("iTime", view.time);
  program.set("iTimeDelta", 1.0f / 60);
  program.set("iFrameRate", 60.0f);
  program.set("iFrame", 0);
}

// Texels in rows; false if there are too many.
template <class Channel>
bool write_rows(std::vector<Channel> texels, int row, int longest_side,
                std::optional<gl::Texture>& texture) {
  const std::size_t width = static_cast<std::size_t>(row), count = texels.size() / 4;
  const std::size_t rows = (count + width - 1) / width;
  if (count == 0) return true;
  if (rows > static_cast<std::size_t>(longest_side)) return false;
  texture.emplace(row, static_cast<int>(rows),
                  sizeof(Channel) == 1 ? gl::Texture::Kind::bytes : gl::Texture::Kind::floats);
  texels.resize(4 * width * rows);
  texture->write(row, static_cast<int>(rows), std::span<const Channel>(texels));
  return true;
}

}  // namespace

SceneTextures::SceneTextures(const FieldText& field, const ShaderLights& lights, int longest_side) {
  if (!write_rows(field.mesh_texels, sdf::mesh_texel_row, longest_side, meshes_))
    throw InputError("--device gl: the distances to the scene's meshes fit no texture",
                     "give a greater --voxel-size, or use --device cpu");
  if (!write_rows(lights.texels, light_texel_row, longest_side, lights_))
    throw InputError("--device gl: the emissive meshes have more faces than a texture holds",
                     "use --device cpu, or fewer faces");
  if (!write_rows(field.images, image_texel_row, longest_side, images_) ||
      !write_rows(field.masks, mask_texel_row, longest_side, masks_))
    throw InputError("--device gl: the scene's textures are more than one texture holds",
                     "use --device cpu, or smaller textures");
}

void SceneTextures::give(gl::Program& program) const {
  const auto bind = [&](const std::optional<gl::Texture>& texture, const char* name, int unit) {
    if (!texture) return;
    texture->bind(unit);
    program.set(name, unit);
  };
  bind(meshes_, "pnb_mesh_texels", kMeshUnit);
  bind(lights_, "pnb_light_texels", kLightUnit);
  bind(images_, "pnb_images", kImageUnit);
  bind(masks_, "pnb_masks", kMaskUnit);
}

std::unique_ptr<gl::Program> field_program(const FieldText& field, const ShaderLights& lights,
                                           const ShadowOptions& shadows, ShaderTask task,
                                           const ShaderView& view) {
  std::unique_ptr<gl::Program> program;
  try {
    program = std::make_unique<gl::Program>(compose_shader(field, lights, shadows, task));
  } catch (const gl::CompileError& error) {
    refuse(error, field);
  }
  set_view(*program, view);
  const Vec3 &lo = field.box.lo, &hi = field.box.hi;
  program->set("pnb_low", lo.x, lo.y, lo.z);
  program->set("pnb_high", hi.x, hi.y, hi.z);
  program->set("pnb_sight", field.sight);
  program->set("pnb_mint", shadows.mint);
  program->set("pnb_march_steps", shadows.steps);
  program->set("pnb_k", shadows.k.value_or(0.0f));
  if (field.user)
    for (const std::string& channel : field.user->channels)
      program->set(channel.c_str(), kEmptyUnit);
  return program;
}

void set_lights(gl::Program& program, std::span<const ShaderLight> lights) {
  std::vector<float> numbers;
  for (const ShaderLight& light : lights)
    for (const float number : light.packed()) numbers.push_back(number);
  program.set("pnb_light_count", static_cast<int>(lights.size()));
  if (!lights.empty()) program.set_vec4s("pnb_lights", numbers);
}

PixelNotes::PixelNotes(float notes) {
  // A shader that did not come to its end has written anything.
  const auto bits = notes >= 1 && notes < 0x1p24f ? static_cast<std::uint64_t>(notes) : 0;
  inside = bits & 2, cut = !(bits & 1) || (bits & 4), unfinished = bits & 8;
  steps = bits >> 4;
}

void refuse_cut_loops(const FieldText& field, const std::string& renderer, std::uint64_t cut,
                      std::uint64_t samples) {
  const std::string what = fmt::format(
      "a loop went on until the driver, {}, ended all loops of the pixel (llvmpipe: after 65,535 "
      "turns), in {} of {} samples",
      renderer, cut, samples);
  const std::string remedy =
      "end every loop sooner; if it is only long, use a graphics processor's driver";
  if (field.user) throw WorkError({field.user->file}, what, remedy);
  throw WorkError(what, remedy);
}

}  // namespace penumbra
