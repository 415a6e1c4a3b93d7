#include "bake/light_key.h"

#include <cmath>
#include <vector>

namespace penumbra::bake {
namespace {

/// What a light is like, whatever its type.
struct Key {
  Vec3 place, direction;
  std::vector<float> sizes;
};

Key key_of(const Light& light) {
  switch (light.type) {
    case LightType::sun:
      return {{}, light.direction, {light.angular_diameter}};
    case LightType::sphere:
      return {light.position, {}, {light.radius}};
    case LightType::disk:
      return {light.position, light.normal, {light.radius}};
    case LightType::rect:
      return {light.position, light.normal, {length(light.edge_u), length(light.edge_v)}};
    case LightType::segment:
      return {light.position, {}, {length(light.edge_u), light.radius}};
    default:
      return {light.position, {}, {}};
  }
}

Json::Value array_of(const Vec3& v) {
  Json::Value a(Json::arrayValue);
  for (int i = 0; i < 3; ++i) a.append(static_cast<double>(v[i]));
  return a;
}

bool is_near(const Json::Value& value, const Vec3& v, float slack) {
  if (!value.isArray() || value.size() != 3) return false;
  for (int i = 0; i < 3; ++i)
    if (!value[i].isNumeric() ||
        !(std::abs(value[i].asDouble() - static_cast<double>(v[i])) <= static_cast<double>(slack)))
      return false;
  return true;
}

}  // namespace

Json::Value light_key(const Light& light) {
  const Key key = key_of(light);
  Json::Value out;
  out["type"] = to_string(light.type);
  out["position"] = array_of(key.place);
  out["direction"] = array_of(key.direction);
  out["sizes"] = Json::arrayValue;
  for (const float size : key.sizes) out["sizes"].append(static_cast<double>(size));
  return out;
}

bool is_light(const Json::Value& key, const Light& light, float extent) {
  if (!key.isObject() || key["type"] != to_string(light.type)) return false;
  const Key wanted = key_of(light);
  if (!is_near(key["position"], wanted.place, 1e-4f * extent)) return false;
  if (!is_near(key["direction"], wanted.direction, 1e-4f)) return false;
  const Json::Value& sizes = key["sizes"];
  if (!sizes.isArray() || sizes.size() != wanted.sizes.size()) return false;
  for (Json::ArrayIndex i = 0; i < sizes.size(); ++i) {
    const auto size = static_cast<double>(wanted.sizes[i]);
    if (!sizes[i].isNumeric() || !(std::abs(sizes[i].asDouble() - size) <= 1e-3 * size))
      return false;
  }
  return true;
}

}  // namespace penumbra::bake
