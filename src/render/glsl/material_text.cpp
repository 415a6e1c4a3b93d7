#include "render/glsl/material_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "image/texture_sampler.h"
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

// What shapes without texture coordinates show: texture coordinates of 0.
Material without_textures(const Scene& scene, Material m) {
  const auto color = [&](const TextureSlot& slot, bool srgb) {
    if (!slot.used()) return Vec3(1);
    const TextureImage& image = scene.textures[static_cast<std::size_t>(slot.image)];
    return TextureSampler(image, srgb).sample(slot, {0, 0}, 0).color;
  };
  const Vec3 metal = color(m.metallic_roughness_map, false);
  m.diffuse = m.diffuse * color(m.diffuse_map, true);
  m.metallic *= metal.z, m.roughness *= metal.y;
  m.emission = m.emission * color(m.emission_map, true);
  return m;
}

std::vector<bool> on_plain_shapes(const Scene& scene) {
  std::vector<bool> plain(scene.materials.size());
  for (const SdfTree& tree : scene.sdfs)
    for (const SdfNode& node : tree.nodes) plain[node.material] = true;
  for (const Sphere& sphere : scene.spheres) plain[sphere.material] = true;
  return plain;
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

std::string material_functions(const Scene& scene) {
  std::string text = "\npnb_Material pnb_material_of(int i) {\n";
  const std::vector<bool> plain = on_plain_shapes(scene);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& given = scene.materials[i];
    const Material m = plain[i] ? without_textures(scene, given) : given;
    const Reflection r = reflection_of(m);
    const float alpha = std::clamp(m.roughness * m.roughness, kLeastAlpha, 1.0f);
    text += fmt::format("  if (i == {})  // {}\n    return pnb_Material({}, {}, {}, {}, {});\n", i,
                        comment(m.name), vec(r.diffuse), vec(r.specular), vec(m.mirror),
                        vec(m.emission), number(alpha));
  }
  return text +
         "  return pnb_Material(vec3(0.8), vec3(0.0), vec3(0.0), vec3(0.0), 1.0);\n}\n\n"
         "pnb_Material pnb_mix_materials(pnb_Material a, pnb_Material b, float s) {\n"
         "  return pnb_Material(mix(a.diffuse, b.diffuse, s), mix(a.specular, b.specular, s),\n"
         "                      mix(a.mirror, b.mirror, s), mix(a.emission, b.emission, s),\n"
         "                      mix(a.alpha, b.alpha, s));\n}\n";
}

namespace {

// What textures and its side change of a material on a facet; empty if nothing does.
std::string changes_of(const Scene& scene, const Material& m, ImageBytes& images) {
  const auto color = [&](const TextureSlot& slot, bool srgb) {
    const bool second = slot.uv_set == 1;
    return images.lookup(scene.textures, slot, srgb, second ? "f.uv.zw" : "f.uv.xy",
                         second ? "width * f.uv_per_metre.y" : "width * f.uv_per_metre.x") +
           ".rgb";
  };
  const TextureSlot &base = m.diffuse_map, &metal = m.metallic_roughness_map;
  std::string text;
  if (base.used() || metal.used()) {
    text += fmt::format("    vec3 base = {}, metal = vec3(1.0);\n", vec(m.diffuse));
    if (base.used()) text += fmt::format("    base *= {};\n", color(base, true));
    if (metal.used()) text += fmt::format("    metal = {};\n", color(metal, false));
    text += m.is_metallic_roughness
                ? fmt::format(
                      "    float metallic = clamp({} * metal.z, 0.0, 1.0);\n"
                      "    m.diffuse = base * ((1.0 - metallic) * {});\n"
                      "    m.specular = vec3({} * (1.0 - metallic)) + base * metallic;\n",
                      number(m.metallic), number(1 - kDielectric), number(kDielectric))
                : "    m.diffuse = base;\n";
    text += fmt::format(
        "    float rough = {} * metal.y;\n    m.alpha = clamp(rough * rough, {}, 1.0);\n",
        number(m.roughness), number(kLeastAlpha));
  }
  if (max_component(m.emission) <= 0) return text;
  if (m.emission_map.used())
    text +=
        fmt::format("    m.emission = {} * {};\n", vec(m.emission), color(m.emission_map, true));
  return m.double_sided ? text : text + "    if (!front) m.emission = vec3(0.0);\n";
}

}  // namespace

std::string facet_materials(const Scene& scene, ImageBytes& images) {
  std::string choice;
  std::vector<bool> on_meshes(scene.materials.size());
  for (const Instance& instance : scene.instances) on_meshes[instance.material] = true;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const std::string changes =
        on_meshes[i] ? changes_of(scene, scene.materials[i], images) : std::string();
    if (!changes.empty()) choice += fmt::format("  if (material == {}) {{\n{}  }}\n", i, changes);
  }
  return "\n// A mesh's material; `width`: of what a pixel sees of it, metres.\n"
         "pnb_Material pnb_facet_material(pnb_Facet f, bool front, float width) {\n"
         "  int material = int(pnb_texel(f.record + 7).w);\n"
         "  pnb_Material m = pnb_material_of(material);\n" +
         choice + "  return m;\n}\n";
}

}  // namespace penumbra
