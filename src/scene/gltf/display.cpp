#include "scene/gltf/display.h"

#include <cmath>

#include "scene/gltf/values.h"

namespace penumbra::gltf {
namespace {

/// An object of any members; empty where the file has none.
Json::Value member(const Json::Value& object, const char* name) {
  if (!object.isObject() || !object[name].isObject()) return Json::objectValue;
  return object[name];
}

Json::Value display_of(const JsonDocument& document) {
  return member(member(member(document.root(), "asset"), "extras"), "penumbra");
}

bool is_radiance(const Json::Value& value) {
  if (!value.isArray() || value.size() != 3) return false;
  for (const Json::Value& channel : value)
    if (!channel.isNumeric() || !(channel.asDouble() >= 0 && channel.asDouble() < 1e12))
      return false;
  return true;
}

}  // namespace

std::optional<double> exposure_of(const JsonDocument& document) {
  const Json::Value value = display_of(document)["exposure_ev"];
  if (!value.isNumeric() || !(std::abs(value.asDouble()) <= 100)) return std::nullopt;
  return value.asDouble();
}

void read_display(const JsonDocument& document, Scene& scene) {
  if (const auto ev = exposure_of(document)) scene.exposure_ev = to_float(*ev);
  const Json::Value display = display_of(document);
  scene.stores_visibility = display["store"].isObject();
  const auto read = [&](const char* name, Vec3& out) {
    const Json::Value& value = display[name];
    if (!is_radiance(value)) return false;
    for (int i = 0; i < 3; ++i) out[i] = to_float(value[i].asDouble());
    return true;
  };
  read("background", scene.background);
  read("ambient", scene.ambient);
}

}  // namespace penumbra::gltf
