#include "scene/gltf/lights.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scene/gltf/axes.h"
#include "scene/gltf/values.h"

namespace penumbra::gltf {
namespace {

using std::numbers::pi;

constexpr double kDegree = pi / 180;

Vec3 times(const Vec3d& color, double factor) {
  return {to_float(color.x * factor), to_float(color.y * factor), to_float(color.z * factor)};
}

/// A positive number of the extras of node or light; 0 if there is none.
double extra(const tinygltf::Node& node, const tinygltf::Light& light, const char* name) {
  const double value = number(node.extras, name).value_or(number(light.extras, name).value_or(0));
  return std::max(value, 0.0);
}

void set_cone(const tinygltf::SpotLight& spot, Light& out) {
  const double outer = std::min(spot.outerConeAngle, pi / 2);
  out.spot_cos_outer = to_float(std::cos(outer));
  out.spot_cos_inner = to_float(std::cos(std::min(spot.innerConeAngle, outer)));
}

void set_sun(const tinygltf::Node& node, const tinygltf::Light& in, const Axes& axes, Light& out) {
  out.type = LightType::sun;
  out.direction = Vec3(-axes.z);
  const double degrees = extra(node, in, "angular_diameter_deg");
  out.angular_diameter = to_float(std::min(degrees, 180.0) * kDegree);
}

/// Point or, with a radius, sphere. `emission` holds the intensity.
void set_point(const tinygltf::Node& node, const tinygltf::Light& in, const Axes& axes,
               Light& out) {
  const double radius = extra(node, in, "radius") * axes.scale;
  if (radius > 0) {
    out.type = LightType::sphere;
    out.radius = to_float(radius);
    out.emission = times(Vec3d(out.emission), 1 / (pi * radius * radius));
  }
  if (in.type == "spot") set_cone(in.spot, out);
}

Light punctual(const tinygltf::Node& node, const tinygltf::Light& in, const Axes& axes) {
  Light out;
  const Vec3d color =
      in.color.size() == 3 ? Vec3d{in.color[0], in.color[1], in.color[2]} : Vec3d{1, 1, 1};
  out.emission = times(color, in.intensity);
  out.name = in.name;
  if (in.type == "directional")
    set_sun(node, in, axes, out);
  else
    set_point(node, in, axes, out);
  return out;
}

double aspect_of(const tinygltf::Value& in) {
  if (in.Has("rect"))
    if (const auto aspect = number(in.Get("rect"), "aspect")) return *aspect;
  return number(in, "aspect").value_or(1);
}

Light area(const tinygltf::Value& in, const Axes& axes) {
  Light out;
  const Vec3d color{number(in, "color", 0).value_or(1), number(in, "color", 1).value_or(1),
                    number(in, "color", 2).value_or(1)};
  out.emission = times(color, number(in, "intensity").value_or(1000));
  out.name = text(in, "name");
  const double size = number(in, "size").value_or(1) * axes.scale;
  if (text(in, "type") == "disk") {
    out.type = LightType::disk;
    out.radius = to_float(size / 2);
    return out;
  }
  out.type = LightType::rect;
  out.edge_u = times(-axes.x, size * aspect_of(in));  // −x × y = −z, the side that emits
  out.edge_v = times(axes.y, size);
  return out;
}

/// The light of the file that `node` refers to by an extension; −1 if none.
int light_index(const tinygltf::Node& node, const char* name) {
  const tinygltf::Value* use = extension(node.extensions, name);
  return use ? static_cast<int>(number(*use, "light").value_or(-1)) : -1;
}

/// Collects the lights of one node after another.
class Collector {
 public:
  Collector(Document& document, const NodeTree& tree) : document_(document), tree_(tree) {}

  void visit(std::size_t node);
  std::vector<Light> take() { return std::move(lights_); }

 private:
  void add(std::size_t node, const Axes& axes, Light light);

  Document& document_;
  const NodeTree& tree_;
  std::vector<Light> lights_;
};

void Collector::add(std::size_t node, const Axes& axes, Light light) {
  light.position = Vec3(axes.origin);
  light.normal = Vec3(-axes.z);
  if (light.name.empty()) light.name = node_name(document_, node);
  const bool has_size = light.type == LightType::sphere || light.type == LightType::disk ||
                        light.type == LightType::rect;
  if (has_size && !is_similarity(tree_.world_from_node[node]))
    document_.warnings().add("a light's size is scaled by the largest of its node's scales",
                             node_name(document_, node));
  lights_.push_back(std::move(light));
}

void Collector::visit(std::size_t i) {
  const tinygltf::Model& model = document_.model();
  const tinygltf::Node& node = model.nodes[i];
  const int point = light_index(node, "KHR_lights_punctual");
  const int flat = light_index(node, "EXT_lights_area");
  if (point < 0 && flat < 0) return;
  const auto axes = axes_of(tree_.world_from_node[i]);
  if (!axes) {
    document_.warnings().add("a light with a singular transform is left out",
                             node_name(document_, i));
    return;
  }
  if (point >= 0)
    add(i, *axes, punctual(node, model.lights[static_cast<std::size_t>(point)], *axes));
  if (flat >= 0)
    add(i, *axes, area(model.extensions.at("EXT_lights_area").Get("lights").Get(flat), *axes));
}

}  // namespace

std::vector<Light> read_lights(Document& document, const NodeTree& tree) {
  Collector collector(document, tree);
  for (std::size_t i = 0; i < tree.in_scene.size(); ++i)
    if (tree.in_scene[i]) collector.visit(i);
  return collector.take();
}

}  // namespace penumbra::gltf
