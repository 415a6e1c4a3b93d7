#include "render/glsl/light_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/glsl/mesh_light_texels.h"
#include "render/glsl/shader_text.h"

namespace penumbra {
namespace {

constexpr std::array<const char*, 7> kNames{"point",   "sphere", "disk", "rect",
                                            "segment", "sun",    "mesh"};
constexpr std::size_t kMesh = 6;

float disk_diameter(float area) { return 2 * std::sqrt(area / std::numbers::pi_v<float>); }

void set_spot(const Light& light, ShaderLight& s) {
  if (light.spot_cos_outer <= -1) return;
  s.spot.x = 1.0f / std::max(1e-4f, light.spot_cos_inner - light.spot_cos_outer);
  s.spot.y = -light.spot_cos_outer * s.spot.x;
}

void set_size(const Light& light, ShaderLight& s) {
  const float sine = std::sin(0.5f * light.angular_diameter);
  switch (light.type) {
    case LightType::sphere:
    case LightType::disk:
      s.diameter = 2 * light.radius;
      break;
    case LightType::rect:
      s.diameter = disk_diameter(length(cross(light.edge_u, light.edge_v)));
      break;
    case LightType::segment:
      s.diameter = disk_diameter(2 * light.radius * length(light.edge_u));
      break;
    case LightType::sun:
      s.diameter = 2 * std::tan(0.5f * light.angular_diameter);
      s.sin2 = sine * sine;
      break;
    default:
      break;
  }
}

ShaderLight shader_light(const Light& light) {
  ShaderLight s;
  s.type = light.type == LightType::point     ? 0
           : light.type == LightType::sphere  ? 1
           : light.type == LightType::disk    ? 2
           : light.type == LightType::rect    ? 3
           : light.type == LightType::segment ? 4
           : light.type == LightType::sun     ? 5
                                              : 6;
  s.position = light.position;
  s.normal = light.type == LightType::sun ? -light.direction : light.normal;
  s.edge_u = light.edge_u;
  s.edge_v = light.edge_v;
  s.emission = light.emission;
  s.radius = light.radius;
  set_spot(light, s);
  set_size(light, s);
  return s;
}

bool has_type(std::span<const ShaderLight> lights, std::size_t type) {
  return std::any_of(lights.begin(), lights.end(), [&](const ShaderLight& l) {
    return static_cast<std::size_t>(l.type) == type;
  });
}

}  // namespace

std::array<float, ShaderLight::packed_size> ShaderLight::packed() const {
  return {position.x,
          position.y,
          position.z,
          static_cast<float>(type),
          normal.x,
          normal.y,
          normal.z,
          radius,
          edge_u.x,
          edge_u.y,
          edge_u.z,
          sin2,
          edge_v.x,
          edge_v.y,
          edge_v.z,
          diameter,
          emission.x,
          emission.y,
          emission.z,
          static_cast<float>(mesh),
          spot.x,
          spot.y,
          static_cast<float>(own),
          0};
}

ShaderLights shader_lights(const Scene& scene) {
  ShaderLights lights;
  for (const Light& light : scene.lights) {
    ShaderLight s = shader_light(light);
    if (light.type == LightType::mesh) {
      const MeshLight mesh(scene, light);
      s.mesh = add_mesh_light(mesh, light.double_sided, lights.texels);
      s.own = light.instance;
      s.position = mesh.center;
      if (!mesh.faces.empty()) s.normal = mesh.faces.front().normal;
    }
    lights.list.push_back(s);
  }
  return lights;
}

std::string light_functions(std::span<const ShaderLight> lights, bool horizon_by_centre) {
  std::string text(shader_text("light.glsl"));
  if (has_type(lights, kMesh)) {
    text.insert(0, "#define PNB_MESH_LIGHTS\n\n");
    text += shader_text("mesh_light.glsl");
  }
  text += shader_text("light_view.glsl");
  if (has_type(lights, 1) || has_type(lights, 5)) text += shader_text("irradiance_cone.glsl");
  if (has_type(lights, 3) || has_type(lights, kMesh))
    text += shader_text("irradiance_polygon.glsl");
  std::string choice;
  for (std::size_t type = 0; type < kNames.size(); ++type) {
    if (!has_type(lights, type)) continue;
    text += '\n';
    text += shader_text(fmt::format("irradiance_{}.glsl", kNames[type]));
    choice += fmt::format("  if (l.type == {}) return pnb_{}_irradiance(l, p, n, {});\n", type,
                          kNames[type], horizon_by_centre);
  }
  return text +
         "\n// Unshadowed irradiance at p, per unit of emission.\n"
         "float pnb_irradiance(pnb_Light l, vec3 p, vec3 n) {\n" +
         choice + "  return 0.0;\n}\n";
}

std::string lights_by_uniforms(bool textured) {
  std::string text;
  if (textured)
    text = fmt::format(R"(
uniform highp sampler2D pnb_light_texels;

vec4 pnb_light_texel(int i) {{
  return texelFetch(pnb_light_texels, ivec2(i % {0}, i / {0}), 0);
}}
)",
                       light_texel_row);
  return text + fmt::format(R"(
uniform vec4 pnb_lights[{}];

pnb_Light pnb_light_at(int i) {{
  vec4 a = pnb_lights[6 * i], b = pnb_lights[6 * i + 1], c = pnb_lights[6 * i + 2];
  vec4 d = pnb_lights[6 * i + 3], e = pnb_lights[6 * i + 4], f = pnb_lights[6 * i + 5];
  return pnb_Light(int(a.w + 0.5), a.xyz, b.xyz, c.xyz, d.xyz, e.xyz, b.w, c.w, d.w, f.xy,
                   int(e.w), int(f.z));
}}
)",
                            lights_at_a_time * ShaderLight::packed_size / 4);
}

}  // namespace penumbra
