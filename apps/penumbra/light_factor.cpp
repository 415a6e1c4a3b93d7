#include "light_factor.h"

#include <fmt/format.h>

#include <charconv>

#include "base/error.h"
#include "base/nearest_name.h"
#include "values.h"

namespace penumbra::app {
namespace {

constexpr const char* kForm = "write it as --light-factor NAME=0.5 or NAME=1,0.8,0.6";
constexpr double kMost = 1e6;

std::size_t find_light(const std::string& name, const Scene& scene) {
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    if (scene.lights[i].name == name) return i;
  std::size_t index = 0;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, index);
  if (error == std::errc() && stop == end && index < scene.lights.size()) return index;
  std::vector<std::string_view> names;
  for (const Light& light : scene.lights)
    if (!light.name.empty()) names.push_back(light.name);
  std::string remedy = scene.lights.empty()
                           ? std::string("the scene has no lights")
                           : fmt::format("give an index, 0 to {}", scene.lights.size() - 1);
  if (!names.empty())
    remedy = fmt::format("did you mean '{}'? An index, 0 to {}, will do too",
                         nearest_name(name, names), scene.lights.size() - 1);
  throw InputError(fmt::format("--light-factor: the scene has no light '{}'", name), remedy);
}

}  // namespace

LightFactor parse_light_factor(const std::string& text) {
  const auto equals = text.rfind('=');
  if (equals == text.npos || equals == 0)
    throw InputError(fmt::format("--light-factor: '{}' names no light", text), kForm);
  const std::vector<std::string> parts = split(text.substr(equals + 1), ',');
  double numbers[3] = {};
  for (std::size_t i = 0; i < parts.size(); ++i)
    if ((parts.size() != 1 && parts.size() != 3) || !read_number(parts[i], numbers[i]) ||
        !(numbers[i] >= 0 && numbers[i] <= kMost))
      throw InputError(
          fmt::format("--light-factor: '{}' is not one or three numbers from 0 to 1e6", text),
          kForm);
  if (parts.size() == 1) numbers[1] = numbers[2] = numbers[0];
  return {text.substr(0, equals), Vec3(Vec3d(numbers[0], numbers[1], numbers[2]))};
}

void apply(const LightFactor& factor, Scene& scene) {
  Light& light = scene.lights[find_light(factor.light, scene)];
  light.emission = light.emission * factor.factor;
  if (light.type != LightType::mesh) return;
  Instance& instance = scene.instances[static_cast<std::size_t>(light.instance)];
  scene.materials.push_back(scene.materials[instance.material]);
  scene.materials.back().emission = light.emission;
  instance.material = static_cast<std::uint32_t>(scene.materials.size() - 1);
}

}  // namespace penumbra::app
