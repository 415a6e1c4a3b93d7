// Reading tinygltf's loosely typed values.
#pragma once

#include <tiny_gltf.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

#include "base/vec.h"

namespace penumbra::gltf {

/// A double as a float; what is too large becomes the largest float.
inline float to_float(double v) {
  constexpr double limit = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(v, -limit, limit));
}

inline float to_unit(double v) { return to_float(std::clamp(v, 0.0, 1.0)); }

/// The number `name` of an object; no value if it is absent or no number.
inline std::optional<double> number(const tinygltf::Value& object, const std::string& name) {
  if (!object.Has(name) || !object.Get(name).IsNumber()) return std::nullopt;
  return object.Get(name).GetNumberAsDouble();
}

/// The truth value `name` of an object; no value if it is absent or none.
inline std::optional<bool> flag(const tinygltf::Value& object, const std::string& name) {
  if (!object.Has(name) || !object.Get(name).IsBool()) return std::nullopt;
  return object.Get(name).Get<bool>();
}

/// The string `name` of an object; empty if it is absent or no string.
inline std::string text(const tinygltf::Value& object, const std::string& name) {
  if (!object.Has(name) || !object.Get(name).IsString()) return {};
  return object.Get(name).Get<std::string>();
}

/// Element i of the array of numbers `name`; no value if there is none.
inline std::optional<double> number(const tinygltf::Value& object, const std::string& name, int i) {
  if (!object.Has(name) || !object.Get(name).IsArray()) return std::nullopt;
  const tinygltf::Value& element = object.Get(name).Get(i);
  if (!element.IsNumber()) return std::nullopt;
  return element.GetNumberAsDouble();
}

/// The extension `name`; null if it is absent.
inline const tinygltf::Value* extension(const tinygltf::ExtensionMap& map,
                                        const std::string& name) {
  const auto it = map.find(name);
  return it == map.end() ? nullptr : &it->second;
}

}  // namespace penumbra::gltf
