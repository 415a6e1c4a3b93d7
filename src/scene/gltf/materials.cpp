#include "scene/gltf/materials.h"

#include <fmt/format.h>

#include <cmath>

#include "scene/gltf/display.h"
#include "scene/gltf/mirror.h"
#include "scene/gltf/own_material.h"
#include "scene/gltf/values.h"

namespace penumbra::gltf {
namespace {

Vec3 unit_color(const std::vector<double>& c) {
  return {to_unit(c[0]), to_unit(c[1]), to_unit(c[2])};
}

void read_metallic_roughness(const tinygltf::PbrMetallicRoughness& in, Textures& textures,
                             Material& out) {
  out.is_metallic_roughness = true;
  out.diffuse = unit_color(in.baseColorFactor);
  out.alpha = to_unit(in.baseColorFactor[3]);
  out.metallic = to_unit(in.metallicFactor);
  out.roughness = to_unit(in.roughnessFactor);
  out.diffuse_map = textures.slot(in.baseColorTexture);
  out.metallic_roughness_map = textures.slot(in.metallicRoughnessTexture);
  if (!out.metallic_roughness_map.used())
    out.mirror = mirror_of_metal(out.diffuse, out.metallic, out.roughness);
}

void read_emission(const tinygltf::Material& in, Textures& textures, Material& out) {
  const tinygltf::Value* e = extension(in.extensions, "KHR_materials_emissive_strength");
  const double strength = e ? number(*e, "emissiveStrength").value_or(1) : 1;
  for (int i = 0; i < 3; ++i)
    out.emission[i] = to_float(in.emissiveFactor[static_cast<std::size_t>(i)] * strength);
  out.emission_map = textures.slot(in.emissiveTexture);
  out.emission_map_lights = e != nullptr;
}

/// What the file was exposed by is taken back, so that baked radiance is radiance again.
void read_unlit(const tinygltf::Material& in, std::optional<double> exposure_ev, Material& out) {
  if (extension(in.extensions, "KHR_materials_unlit") == nullptr) return;
  out.unlit = to_float(std::exp2(-exposure_ev.value_or(0)));
  out.mirror = out.emission = {};
  out.emission_map = {};
}

void read_alpha(const tinygltf::Material& in, const std::string& name, Warnings& warnings,
                Material& out) {
  if (in.alphaMode == "MASK") out.alpha_cutoff = to_float(in.alphaCutoff);
  if (in.alphaMode != "BLEND") return;
  warnings.add(out.alpha < 0.5f ? "alphaMode BLEND is shown opaque though alpha is below 0.5"
                                : "alphaMode BLEND is shown opaque",
               name);
}

}  // namespace

std::vector<Material> read_materials(Document& document, Textures& textures) {
  std::vector<Material> materials;
  for (const tinygltf::Material& in : document.model().materials) {
    Material& out = materials.emplace_back();
    out.name = in.name;
    out.double_sided = in.doubleSided;
    read_metallic_roughness(in.pbrMetallicRoughness, textures, out);
    read_own_material(
        document.json().root()["materials"][static_cast<Json::ArrayIndex>(materials.size() - 1)],
        out);
    read_emission(in, textures, out);
    read_unlit(in, exposure_of(document.json()), out);
    const std::string name =
        in.name.empty() ? fmt::format("material {}", materials.size() - 1) : in.name;
    read_alpha(in, name, document.warnings(), out);
  }
  return materials;
}

Material default_material() {
  Material material;
  material.name = "default";
  material.is_metallic_roughness = true;
  material.roughness = 1;
  material.double_sided = false;
  return material;
}

}  // namespace penumbra::gltf
