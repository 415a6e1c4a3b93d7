#include "scene/gltf/extensions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace penumbra::gltf {
namespace {

using Pair = std::pair<std::string_view, std::string_view>;

constexpr std::array<std::string_view, 6> kImplemented = {
    "KHR_texture_transform", "KHR_materials_emissive_strength",
    "KHR_materials_unlit",   "KHR_lights_punctual",
    "EXT_lights_area",       "KHR_mesh_quantization"};

constexpr std::array<Pair, 7> kRemedies = {{
    {"KHR_draco_mesh_compression", "re-export without Draco compression"},
    {"EXT_meshopt_compression", "re-export without meshopt compression"},
    {"KHR_meshopt_compression", "re-export without meshopt compression"},
    {"KHR_texture_basisu", "re-export with PNG or JPEG textures"},
    {"EXT_texture_webp", "re-export with PNG or JPEG textures"},
    {"EXT_texture_avif", "re-export with PNG or JPEG textures"},
    {"EXT_mesh_gpu_instancing", "re-export with one node for each instance"},
}};

constexpr std::array<Pair, 13> kVisible = {{
    {"KHR_materials_transmission", "transparent surfaces are shown opaque"},
    {"KHR_materials_diffuse_transmission", "translucent surfaces are shown opaque"},
    {"KHR_materials_volume", "volumes are shown as surfaces"},
    {"KHR_materials_clearcoat", "clear coats are left out"},
    {"KHR_materials_sheen", "sheen is left out"},
    {"KHR_materials_iridescence", "iridescence is left out"},
    {"KHR_materials_anisotropy", "anisotropy is left out"},
    {"KHR_materials_pbrSpecularGlossiness", "its materials are replaced by metallic-roughness"},
    {"EXT_mesh_gpu_instancing", "only one of each group of instances is shown"},
    {"KHR_texture_basisu", "its textures are replaced by PNG or JPEG, or white"},
    {"EXT_texture_webp", "its textures are replaced by PNG or JPEG, or white"},
    {"EXT_texture_avif", "its textures are replaced by PNG or JPEG, or white"},
    {"EXT_lights_image_based", "its light is left out"},
}};

template <std::size_t N>
std::string_view find(const std::array<Pair, N>& pairs, std::string_view name) {
  const auto it =
      std::find_if(pairs.begin(), pairs.end(), [&](const Pair& p) { return p.first == name; });
  return it == pairs.end() ? std::string_view() : it->second;
}

}  // namespace

bool is_implemented(std::string_view extension) {
  return std::find(kImplemented.begin(), kImplemented.end(), extension) != kImplemented.end();
}

void check_extensions(const JsonDocument& document, Warnings& warnings) {
  const Json::Value& required = document.root()["extensionsRequired"];
  for (Json::ArrayIndex i = 0; i < required.size(); ++i) {
    const std::string name = required[i].asString();
    if (is_implemented(name)) continue;
    const std::string_view remedy = find(kRemedies, name);
    throw document.error(fmt::format("extensionsRequired[{}]", i),
                         fmt::format("{} is required but not supported", name.substr(0, 100)),
                         remedy.empty() ? "re-export without it" : std::string(remedy));
  }
  for (const Json::Value& used : document.root()["extensionsUsed"])
    if (const auto effect = find(kVisible, used.asString()); !effect.empty())
      warnings.add(fmt::format("{} is not supported: {}", used.asString(), effect));
}

}  // namespace penumbra::gltf
