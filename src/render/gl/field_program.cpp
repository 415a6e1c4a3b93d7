#include "render/gl/field_program.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "sdf/glsl/generate.h"

namespace penumbra {
namespace {

constexpr int kEmptyUnit = 7;  // no texture is ever bound there
constexpr int kMeshUnit = 5;

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

}  // namespace

MeshTexture::MeshTexture(const FieldText& field, int longest_side) {
  const std::size_t count = field.mesh_texels.size() / 4;
  if (count == 0) return;
  constexpr std::size_t row = sdf::mesh_texel_row;
  const std::size_t rows = (count + row - 1) / row;
  if (rows > static_cast<std::size_t>(longest_side))
    throw InputError("--device gl: the distances to the scene's meshes fit no texture",
                     "give a greater --voxel-size, or use --device cpu");
  texture_.emplace(static_cast<int>(row), static_cast<int>(rows));
  std::vector<float> texels = field.mesh_texels;
  texels.resize(4 * row * rows);
  texture_->write(static_cast<int>(row), static_cast<int>(rows), texels);
}

void MeshTexture::give(gl::Program& program) const {
  if (!texture_) return;
  texture_->bind(kMeshUnit);
  program.set("pnb_mesh_texels", kMeshUnit);
}

std::unique_ptr<gl::Program> field_program(const FieldText& field,
                                           const std::vector<ShaderLight>& lights,
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
