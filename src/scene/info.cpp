#include "scene/info.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace penumbra {
namespace {

// "key         value" lines, the values below one another.
void line(std::string& out, std::string_view key, std::string_view value) {
  out += fmt::format("{:<12}{}\n", key, value);
}

// Names come from files and may hold anything.
std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

// Adding zero turns -0 into 0.
std::string number(float x) { return fmt::format("{:.6g}", x + 0.0f); }

std::string triple(const Vec3& v) {
  return fmt::format("({}, {}, {})", number(v.x), number(v.y), number(v.z));
}

std::string degrees(float radians) {
  return fmt::format("{:.4g} deg", radians * 180 / std::numbers::pi_v<float>);
}

std::string quoted(const std::string& name) {
  return name.empty() ? "(no name)" : fmt::format("\"{}\"", printable(name));
}

std::string light_shape(const Scene& scene, const Light& light) {
  switch (light.type) {
    case LightType::point:
      return fmt::format("at {}", triple(light.position));
    case LightType::sphere:
      return fmt::format("at {}, radius {} m", triple(light.position), number(light.radius));
    case LightType::disk:
      return fmt::format("at {}, facing {}, radius {} m", triple(light.position),
                         triple(light.normal), number(light.radius));
    case LightType::rect:
      return fmt::format("at {}, facing {}, {} x {} m", triple(light.position),
                         triple(light.normal), number(length(light.edge_u)),
                         number(length(light.edge_v)));
    case LightType::segment:
      return fmt::format("at {}, {} m along {}, radius {} m", triple(light.position),
                         number(length(light.edge_u)), triple(normalize(light.edge_u)),
                         number(light.radius));
    case LightType::sun:
      return fmt::format("towards {}, {} wide", triple(light.direction),
                         degrees(light.angular_diameter));
    case LightType::mesh:
      break;
  }
  const Instance& instance = scene.instances[static_cast<std::size_t>(light.instance)];
  const Bounds bounds = bounds_of(scene, instance);
  return fmt::format("at {}, {} triangles, size {} m, emits to {}", triple(bounds.center()),
                     scene.meshes[instance.mesh].triangle_count(), triple(bounds.size()),
                     light.double_sided ? "both sides" : "its front");
}

std::string_view emission_word(LightType type) {
  if (type == LightType::point) return "intensity";
  return type == LightType::sun ? "irradiance" : "radiance";
}

std::string light_text(const Scene& scene, const Light& light) {
  std::string text =
      fmt::format("{:<8}{}  {}, {} {}", to_string(light.type), quoted(light.name),
                  light_shape(scene, light), emission_word(light.type), triple(light.emission));
  if (light.spot_cos_outer > -1)
    text += fmt::format(", a spot along {} of {}", triple(light.normal),
                        degrees(2 * std::acos(light.spot_cos_outer)));
  return text;
}

std::string camera_text(const Camera& camera) {
  const std::string opening =
      camera.ortho_height ? fmt::format("orthographic, {} m high", number(*camera.ortho_height))
                          : fmt::format("{} high", degrees(camera.vertical_fov));
  return fmt::format("{}  from {} to {}, {}", quoted(camera.name), triple(camera.position),
                     triple(camera.look_at), opening);
}

std::string field_text(const Scene& scene, const SdfTree& tree) {
  std::array<std::size_t, sdf_op_count> count{};
  std::vector<std::uint32_t> depth(tree.nodes.size(), 1);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const SdfNode& node = tree.nodes[i];
    ++count[static_cast<std::size_t>(node.op)];
    for (std::uint32_t c = 0; c < node.child_count; ++c) depth[node.first_child + c] = depth[i] + 1;
  }
  std::string ops;
  for (const SdfSignature& s : sdf_signatures())
    if (const std::size_t n = count[static_cast<std::size_t>(s.op)]; n > 0)
      ops += fmt::format("{}{} {}", ops.empty() ? "" : ", ", n, s.name);
  const Bounds box = bounds_of(tree);
  return fmt::format("{}  {} nodes, {} levels: {}; {}", quoted(scene.objects[tree.object].name),
                     tree.nodes.size(), *std::ranges::max_element(depth), ops,
                     is_finite(box) ? fmt::format("within {} to {}", triple(box.lo), triple(box.hi))
                                    : "unbounded");
}

void field_lines(std::string& out, const Scene& scene) {
  if (!scene.sdfs.empty()) line(out, "fields", fmt::format("{}", scene.sdfs.size()));
  for (std::size_t i = 0; i < scene.sdfs.size(); ++i)
    line(out, fmt::format("{:>4}", i), field_text(scene, scene.sdfs[i]));
  if (scene.glsl) line(out, "shader", printable(scene.glsl->path));
}

void geometry_lines(std::string& out, const Scene& scene) {
  std::size_t unique = 0, placed = 0;
  for (const Mesh& mesh : scene.meshes) unique += mesh.triangle_count();
  for (const Instance& instance : scene.instances)
    placed += scene.meshes[instance.mesh].triangle_count();
  line(out, "objects", fmt::format("{}", scene.objects.size()));
  line(out, "meshes",
       fmt::format("{}, placed {} times", scene.meshes.size(), scene.instances.size()));
  line(out, "triangles", fmt::format("{} unique, {} with all instances", unique, placed));
  if (scene.report.dropped_triangles > 0)
    line(out, "dropped", fmt::format("{} triangles of zero area", scene.report.dropped_triangles));
  line(out, "spheres", fmt::format("{}", scene.spheres.size()));
  field_lines(out, scene);
  const Bounds bounds = bounds_of(scene);
  if (bounds.empty()) return line(out, "bounds", "empty");
  line(out, "bounds", fmt::format("{} to {}", triple(bounds.lo), triple(bounds.hi)));
  line(out, "size", fmt::format("{} m", triple(bounds.size())));
}

void appearance_lines(std::string& out, const Scene& scene) {
  line(out, "materials", fmt::format("{}", scene.materials.size()));
  line(out, "textures", fmt::format("{}", scene.textures.size()));
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    const TextureImage& t = scene.textures[i];
    line(out, fmt::format("{:>4}", i),
         fmt::format("{}  {} x {}", quoted(t.name), t.width, t.height));
  }
  line(out, "ambient", scene.ambient_is_automatic ? "automatic" : triple(scene.ambient));
  line(out, "background", triple(scene.background));
}

void light_and_camera_lines(std::string& out, const Scene& scene) {
  line(out, "lights", fmt::format("{}", scene.lights.size()));
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    line(out, fmt::format("{:>4}", i), light_text(scene, scene.lights[i]));
  line(out, "cameras", fmt::format("{}", scene.cameras.size()));
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    line(out, fmt::format("{:>4}", i), camera_text(scene.cameras[i]));
}

}  // namespace

std::string describe(const Scene& scene) {
  std::string out;
  line(out, "format", printable(scene.report.format));
  geometry_lines(out, scene);
  appearance_lines(out, scene);
  light_and_camera_lines(out, scene);
  for (const std::string& text : scene.report.conversions) line(out, "converted", printable(text));
  for (const std::string& text : scene.report.warnings) line(out, "warning", printable(text));
  return out;
}

}  // namespace penumbra
