#include "light_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "values.h"

namespace penumbra::app {
namespace {

constexpr float kRadians = std::numbers::pi_v<float> / 180;
// As in scene files: squares of lengths and sums of light stay within floats.
constexpr double kFarthest = 1e9, kBrightest = 1e12;
constexpr float kSmallest = 1e-12f;

struct Form {
  LightType type;
  std::string_view name, values;
  std::size_t count;  // of numbers before the emission
};

constexpr std::array<Form, 6> kForms{
    {{LightType::sphere, "sphere", "px,py,pz,radius,radiance", 4},
     {LightType::disk, "disk", "px,py,pz,nx,ny,nz,radius,radiance", 7},
     {LightType::rect, "rect", "cx,cy,cz,ux,uy,uz,vx,vy,vz,radiance", 9},
     {LightType::segment, "segment", "ax,ay,az,bx,by,bz,radius,radiance", 7},
     {LightType::point, "point", "px,py,pz,intensity", 3},
     {LightType::sun, "sun", "dx,dy,dz,angular_diameter_deg,irradiance", 4}}};

const Form& form_of(const std::string& name) {
  std::array<std::string_view, kForms.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kForms[i].name;
  return kForms[parse_choice("--light", name, names)];
}

// The numbers of one SPEC, and how to complain about them.
struct Spec {
  const std::string& text;
  const Form& form;
  std::vector<float> numbers;

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(fmt::format("--light {}: {}", text, what),
                     fmt::format("write {}:{}", form.name, form.values));
  }
  Vec3 vec(std::size_t at) const { return {numbers[at], numbers[at + 1], numbers[at + 2]}; }
  Vec3 unit(std::size_t at, const char* name) const {
    const Vec3d v(vec(at));
    if (!(length(v) > 0)) refuse(fmt::format("the {} is zero", name));
    return Vec3(normalize(v));
  }
  float radius(std::size_t at) const {
    if (!(numbers[at] > 0)) refuse("the radius is not positive");
    if (numbers[at] < kSmallest) refuse(fmt::format("the radius is below {:g}", kSmallest));
    return numbers[at];
  }
  Vec3 emission() const {
    const bool gray = numbers.size() == form.count + 1;
    const Vec3 e = gray ? Vec3(numbers.back()) : vec(form.count);
    if (e.x < 0 || e.y < 0 || e.z < 0) refuse("the emission is negative");
    return e;
  }
};

Spec read_spec(const std::string& text) {
  const auto colon = text.find(':');
  Spec spec{text, form_of(text.substr(0, colon)), {}};
  if (colon == text.npos) spec.refuse("there are no numbers");
  for (const std::string& part : split(text.substr(colon + 1), ',')) {
    double value = 0;
    if (!read_number(part, value)) spec.refuse(fmt::format("'{}' is not a number", part));
    const double most = spec.numbers.size() < spec.form.count ? kFarthest : kBrightest;
    if (std::abs(value) > most) spec.refuse(fmt::format("'{}' is beyond {:g}", part, most));
    spec.numbers.push_back(static_cast<float>(value));
  }
  const std::size_t found = spec.numbers.size(), needed = spec.form.count;
  if (found != needed + 1 && found != needed + 3)
    spec.refuse(fmt::format("{} numbers instead of {} or {}", found, needed + 1, needed + 3));
  return spec;
}

void set_rect(Light& light, const Spec& spec) {
  light.edge_u = spec.vec(3);
  light.edge_v = spec.vec(6);
  light.position = spec.vec(0) + (light.edge_u + light.edge_v) * 0.5f;
  const Vec3d across = cross(Vec3d(light.edge_u), Vec3d(light.edge_v));
  if (!(length(across) > 0)) spec.refuse("the edges span no area");
  light.normal = Vec3(normalize(across));
}

void set_segment(Light& light, const Spec& spec) {
  light.edge_u = spec.vec(3) - spec.vec(0);
  light.position = (spec.vec(0) + spec.vec(3)) * 0.5f;
  light.radius = spec.radius(6);
  if (!(length(Vec3d(light.edge_u)) > 0)) spec.refuse("its ends are the same point");
}

void set_sun(Light& light, const Spec& spec) {
  light.direction = spec.unit(0, "direction");
  if (!(spec.numbers[3] >= 0 && spec.numbers[3] < 180))
    spec.refuse("the angular diameter is not in [0, 180) degrees");
  light.angular_diameter = spec.numbers[3] * kRadians;
}

void set_shape(Light& light, const Spec& spec) {
  if (light.type == LightType::rect) return set_rect(light, spec);
  if (light.type == LightType::segment) return set_segment(light, spec);
  if (light.type == LightType::sun) return set_sun(light, spec);
  light.position = spec.vec(0);
  if (light.type == LightType::sphere) light.radius = spec.radius(3);
  if (light.type == LightType::disk) {
    light.normal = spec.unit(3, "normal");
    light.radius = spec.radius(6);
  }
}

}  // namespace

Light parse_light(const std::string& text) {
  const Spec spec = read_spec(text);
  Light light;
  light.type = spec.form.type;
  set_shape(light, spec);
  light.emission = spec.emission();
  return light;
}

void drop_lights(Scene& scene) {
  scene.lights.clear();
  for (Instance& instance : scene.instances) instance.mesh_light = -1;
}

std::vector<std::string> scale_lights(Scene& scene, float factor) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    Light& light = scene.lights[i];
    if (light.type == LightType::mesh)
      warnings.push_back(fmt::format("--light-size: light {} is a mesh and keeps its size", i));
    light.radius *= factor;
    // A light of half the sky is as wide as a disk can look.
    light.angular_diameter = std::min(light.angular_diameter * factor, 179 * kRadians);
    if (light.type == LightType::rect) light.edge_u *= factor, light.edge_v *= factor;
    if (std::max({light.radius, length(light.edge_u), length(light.edge_v)}) > kFarthest)
      throw InputError(fmt::format("--light-size: light {} becomes larger than {:g}", i, kFarthest),
                       "give a smaller factor");
  }
  return warnings;
}

}  // namespace penumbra::app
