#include "render/glsl/material_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "sdf/glsl/numbers.h"

namespace penumbra {
namespace {

using sdf::number;

constexpr float kDielectric = 0.04f, kLeastAlpha = 0.002f;  // as in material_lookup.cpp

std::string vec(const Vec3& v) { return sdf::vector(Vec3d(v)); }

struct Reflection {
  Vec3 diffuse, specular;
};

Reflection reflection_of(const Material& m) {
  if (!m.is_metallic_roughness) return {m.diffuse, m.specular};
  const float metallic = std::clamp(m.metallic, 0.0f, 1.0f);
  return {m.diffuse * ((1 - metallic) * (1 - kDielectric)),
          Vec3(kDielectric * (1 - metallic)) + m.diffuse * metallic};
}

std::string comment(const std::string& name) {
  std::string text = name;
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == '\\') c = ' ';
  return text;
}

}  // namespace

std::string material_type() {
  return R"(
struct pnb_Material {
  vec3 diffuse, specular;  // albedo; reflectance at normal incidence
  vec3 mirror, emission;
  float alpha;  // GGX roughness
};
)";
}

std::string material_functions(const Scene& scene, std::vector<std::string>& warnings) {
  std::string text = "\npnb_Material pnb_material_of(int i) {\n";
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    const Reflection r = reflection_of(m);
    const float alpha = std::clamp(m.roughness * m.roughness, kLeastAlpha, 1.0f);
    text += fmt::format("  if (i == {})  // {}\n    return pnb_Material({}, {}, {}, {}, {});\n", i,
                        comment(m.name), vec(r.diffuse), vec(r.specular), vec(m.mirror),
                        vec(m.emission), number(alpha));
    if (m.diffuse_map.used())
      warnings.push_back(
          fmt::format("the texture of material \"{}\" is left out in shaders", comment(m.name)));
  }
  return text +
         "  return pnb_Material(vec3(0.8), vec3(0.0), vec3(0.0), vec3(0.0), 1.0);\n}\n\n"
         "pnb_Material pnb_mix_materials(pnb_Material a, pnb_Material b, float s) {\n"
         "  return pnb_Material(mix(a.diffuse, b.diffuse, s), mix(a.specular, b.specular, s),\n"
         "                      mix(a.mirror, b.mirror, s), mix(a.emission, b.emission, s),\n"
         "                      mix(a.alpha, b.alpha, s));\n}\n";
}

}  // namespace penumbra
