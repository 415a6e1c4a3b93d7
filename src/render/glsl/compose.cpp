#include "render/glsl/compose.h"

#include <fmt/format.h>

#include "render/glsl/fraction_text.h"
#include "render/glsl/shader_text.h"

namespace penumbra {
namespace {

constexpr const char* kUniforms = R"(
uniform vec3 pnb_low, pnb_high;  // the scene's box enlarged by its diagonal
uniform float pnb_sight;         // how far rays go; 0: to where they leave the box
uniform int pnb_march_steps;     // of the published marches
uniform float pnb_mint, pnb_k;   // where they begin; 1 / w, or 0: by the light's size

)";

std::string user_text(const UserShader& user) {
  std::string text;
  for (const std::string& channel : user.channels)
    text += "uniform highp sampler2D " + channel + ";\n";
  text += fmt::format("#line 1 1\n{}\n#line {} 0\n", user.code, first_line_of_ours);
  return text + "precision highp float;\nprecision highp int;\n" + without_macros(user);
}

bool by_points(const ShadowOptions& shadows) { return shadows.kind == ShadowKind::area; }

bool horizon_by_centre(const ShadowOptions& shadows) { return shadows.kind == ShadowKind::hard; }

std::string field_functions(const FieldText& field, const ShaderLights& lights,
                            const ShadowOptions& shadows) {
  std::string text = field.generated;
  text += "\n#define PENUMBRA_MAP pnb_map\n#define PENUMBRA_STEPS pnb_march_steps\n";
  text += kUniforms;
  text += shader_text("soft_shadow.glsl");
  text += '\n';
  text += light_functions(lights.list, horizon_by_centre(shadows));
  text += lights_by_uniforms(!lights.texels.empty());
  text += '\n';
  text += shader_text("trace.glsl");
  text += shader_text("surface.glsl");
  text += fraction_function(shadows);
  text += shader_text("notes.glsl");
  if (field.glossy) text += shader_text("glossy.glsl");
  if (by_points(shadows)) text += shader_text("light_points.glsl");
  return text;
}

}  // namespace

std::string compose_shader(const FieldText& field, const ShaderLights& lights,
                           const ShadowOptions& shadows, ShaderTask task) {
  std::string text = fmt::format("#version 300 es\n#line {} 0\n", first_line_of_ours);
  if (by_points(shadows)) text += "#define PNB_BY_POINTS\n";
  if (field.glossy) text += "#define PNB_GLOSSY\n";
  if (task == ShaderTask::picture_with_layers) text += "#define PNB_LAYERS\n";
  text += shader_text("prelude.glsl");
  if (field.user) text += user_text(*field.user);
  if (task == ShaderTask::own_picture) return text.append(shader_text("image.glsl"));
  text += field_functions(field, lights, shadows);
  return text.append(shader_text(task == ShaderTask::probe ? "probe.glsl" : "picture.glsl"));
}

}  // namespace penumbra
