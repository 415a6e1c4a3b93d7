#include "scene/gltf/own_material.h"

#include <optional>

namespace penumbra::gltf {
namespace {

std::optional<float> unit(const Json::Value& value) {
  if (!value.isNumeric() || !(value.asDouble() >= 0 && value.asDouble() <= 1)) return std::nullopt;
  return static_cast<float>(value.asDouble());
}

std::optional<Vec3> color(const Json::Value& value) {
  if (!value.isArray() || value.size() != 3) return std::nullopt;
  Vec3 out;
  for (int i = 0; i < 3; ++i) {
    const auto channel = unit(value[i]);
    if (!channel) return std::nullopt;
    out[i] = *channel;
  }
  return out;
}

}  // namespace

void read_own_material(const Json::Value& material, Material& out) {
  const Json::Value& extras = material["extras"];
  if (!extras.isObject() || !extras["penumbra"].isObject()) return;
  const Json::Value& own = extras["penumbra"];
  const auto diffuse = color(own["diffuse"]), specular = color(own["specular"]),
             mirror = color(own["mirror"]);
  const auto roughness = unit(own["roughness"]);
  if (!diffuse || !specular || !mirror || !roughness) return;
  out.is_metallic_roughness = false;
  out.metallic = 0;
  out.metallic_roughness_map = {};
  out.diffuse = *diffuse, out.specular = *specular, out.mirror = *mirror;
  out.roughness = *roughness;
}

}  // namespace penumbra::gltf
