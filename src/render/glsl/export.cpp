#include "render/glsl/export.h"

#include <fmt/format.h>

#include "base/error.h"
#include "render/camera_rays.h"
#include "render/glsl/fraction_text.h"
#include "render/glsl/light_text.h"
#include "render/glsl/shader_text.h"
#include "render/pixel_samples.h"
#include "sdf/glsl/numbers.h"

namespace penumbra {
namespace {

using sdf::number;

std::string vec(const Vec3& v) { return sdf::vector(Vec3d(v)); }

std::string constant(const char* type, const char* name, const std::string& value) {
  return fmt::format("const {} pnb_{} = {};\n", type, name, value);
}

std::string light_text(const ShaderLight& l, std::size_t index, const std::string& name) {
  return fmt::format(
      "  if (i == {})  // {}\n    return pnb_Light({}, {}, {},\n                     {}, {}, {},\n"
      "                     {}, {}, {}, vec2({}, {}), {}, {});\n",
      index, name.empty() ? "light" : name, l.type, vec(l.position), vec(l.normal), vec(l.edge_u),
      vec(l.edge_v), vec(l.emission), number(l.radius), number(l.sin2), number(l.diameter),
      number(l.spot.x), number(l.spot.y), l.mesh, l.own);
}

// The texels of mesh lights as a table.
std::string light_table(const std::vector<float>& texels) {
  const std::size_t count = texels.size() / 4;
  std::string text = fmt::format("\nconst vec4 pnb_light_texels[{0}] = vec4[{0}](\n", count);
  for (std::size_t i = 0; i < count; ++i)
    text += fmt::format("  vec4({}, {}, {}, {}){}\n", number(texels[4 * i]),
                        number(texels[4 * i + 1]), number(texels[4 * i + 2]),
                        number(texels[4 * i + 3]), i + 1 < count ? "," : ");");
  return text + "\nvec4 pnb_light_texel(int i) { return pnb_light_texels[i]; }\n";
}

std::string light_list(const Scene& scene, const ShaderLights& all) {
  const std::vector<ShaderLight>& lights = all.list;
  std::string text = all.texels.empty() ? "" : light_table(all.texels);
  text += "\n// The lights: see struct Light for the order of values.\n";
  text += fmt::format("const int pnb_light_count = {};\n\npnb_Light pnb_light_at(int i) {{\n",
                      lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i)
    text += light_text(lights[i], i, to_string(scene.lights[i].type));
  return text +
         "  return pnb_Light(0, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0, "
         "0.0, 0.0, vec2(0.0), -1, -1);\n}\n";
}

std::string camera_text(const CameraRays& camera, int height) {
  const float half = 0.5f * static_cast<float>(height);
  return constant("vec3", "eye", vec(camera.origin())) +
         constant("vec3", "forward", vec(camera.forward())) +
         constant("vec3", "right", vec(camera.step_x() * half)) +
         constant("vec3", "up", vec(camera.step_y() * -half)) + "#define PNB_RAY " +
         (camera.orthographic() ? "pnb_radiance(pnb_eye + aside, pnb_forward)\n"
                                : "pnb_radiance(pnb_eye, normalize(pnb_forward + aside))\n");
}

// From the pixel's middle, upwards.
std::string sample_text(int spp) {
  std::string list;
  for (int i = 0; i < spp; ++i) {
    const Vec2 at = pixel_sample(i, spp);
    list +=
        fmt::format("{}vec2({}, {})", i == 0 ? "" : ", ", number(at.x - 0.5), number(0.5 - at.y));
  }
  return fmt::format(
      "const int pnb_samples = {0};\n"
      "vec2 pnb_sample_at(int i) {{ return vec2[{0}]({1})[i]; }}\n",
      spp, list);
}

std::string settings(const Scene& scene, const FieldText& field, const RenderOptions& o,
                     float exposure_ev, const Vec3& ambient) {
  const CameraRays camera(scene.cameras[static_cast<std::size_t>(o.camera)], o.width, o.height);
  return camera_text(camera, o.height) + constant("float", "exposure", number(exposure_ev)) +
         constant("vec3", "ambient", vec(ambient)) +
         constant("vec3", "background", vec(scene.background)) +
         constant("int", "mirrors", std::to_string(field.mirrors ? o.mirror_depth : 0)) +
         constant("vec3", "low", vec(field.box.lo)) + constant("vec3", "high", vec(field.box.hi)) +
         constant("float", "sight", number(field.sight)) +
         constant("int", "march_steps", std::to_string(o.shadows.steps)) +
         constant("float", "mint", number(o.shadows.mint)) +
         constant("float", "k", number(o.shadows.k.value_or(0))) + sample_text(o.spp);
}

// Without a person's names beside them ours need no prefix.
std::string without_prefix(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    if (text.compare(i, 4, "pnb_") == 0 || text.compare(i, 4, "PNB_") == 0)
      i += 4;
    else
      result += text[i++];
  }
  return result;
}

}  // namespace

std::string shadertoy_text(const Scene& scene, const FieldText& field, const RenderOptions& options,
                           float exposure_ev, const Vec3& ambient, const std::string& source) {
  const ShadowKind kind = options.shadows.kind;
  if (kind == ShadowKind::area || kind == ShadowKind::parker)
    throw InputError("a shader cannot have this shadow method",
                     "use --shadows none, hard, sdf-classic, sdf-improved or sdf-inner");
  const ShaderLights lights = shader_lights(scene);
  std::string text = fmt::format("// {}: a shader for Shadertoy, written by Penumbra.\n", source);
  if (field.glossy) text += "#define PNB_GLOSSY\n";
  text += "#define pnb_zero min(iFrame, 0)  // keeps compilers from unrolling\n\n";
  text += settings(scene, field, options, exposure_ev, ambient);
  if (field.user) text += '\n' + field.user->code + '\n' + without_macros(*field.user);
  text += field.generated;
  text += "\n#define PENUMBRA_MAP pnb_map\n#define PENUMBRA_STEPS pnb_march_steps\n\n";
  text += shader_text("soft_shadow.glsl");
  text += '\n' + light_functions(lights.list, kind == ShadowKind::hard) + light_list(scene, lights);
  text += '\n';
  text += shader_text("trace.glsl");
  text += shader_text("surface.glsl");
  text += fraction_function(options.shadows);
  if (field.glossy) text += shader_text("glossy.glsl");
  text += shader_text("shadertoy.glsl");
  return field.user ? text : without_prefix(text);
}

}  // namespace penumbra
