// glTF 2.0, text and binary: the parts of the reader, put together.
#include <fmt/format.h>

#include <map>
#include <optional>
#include <utility>

#include "scene/gltf/cameras.h"
#include "scene/gltf/display.h"
#include "scene/gltf/document.h"
#include "scene/gltf/lights.h"
#include "scene/gltf/materials.h"
#include "scene/gltf/motion.h"
#include "scene/gltf/node_tree.h"
#include "scene/gltf/primitive.h"
#include "scene/gltf/textures.h"
#include "scene/gltf/values.h"
#include "scene/load.h"

namespace penumbra {
namespace gltf {
namespace {

/// Every node may use a mesh of any number of primitives: a short file could ask for billions.
constexpr std::size_t kMostInstances = 4'000'000;

void check_instance_count(const Document& document, const NodeTree& tree) {
  const tinygltf::Model& model = document.model();
  std::size_t count = 0;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (!tree.in_scene[i] || model.nodes[i].mesh < 0) continue;
    count += model.meshes[static_cast<std::size_t>(model.nodes[i].mesh)].primitives.size();
    if (count > kMostInstances)
      throw document.json().error(
          fmt::format("nodes[{}]", i),
          fmt::format("the scene has more than {} instances", kMostInstances),
          "join meshes before exporting");
  }
}

/// alphaMode MASK with a factor below the cutoff and no texture: a hole everywhere.
bool is_cut_away(const Material& material) {
  return material.alpha_cutoff && !material.diffuse_map.used() &&
         material.alpha < *material.alpha_cutoff;
}

/// `extras.samples_scale` of a node, 1 without it.
float samples_scale(const Document& document, std::size_t node) {
  const Json::Value& extras =
      document.json().root()["nodes"][static_cast<Json::ArrayIndex>(node)]["extras"];
  if (!extras.isObject() || !extras.isMember("samples_scale")) return 1;
  const Json::Value& scale = extras["samples_scale"];
  if (!scale.isNumeric() || !(scale.asDouble() >= 1e-3 && scale.asDouble() <= 1e3))
    throw document.json().error(
        fmt::format("nodes[{}].extras.samples_scale", node),
        scale.isNumeric() ? fmt::format("it is {:g}", scale.asDouble()) : "it is no number",
        "give a number from 0.001 to 1000");
  return to_float(scale.asDouble());
}

/// Fills meshes, instances and objects of a scene from the nodes.
class Builder {
 public:
  Builder(Document& document, const NodeTree& tree, Scene& scene)
      : document_(document), tree_(tree), scene_(scene) {}

  void add_node(std::size_t node);

 private:
  std::optional<std::uint32_t> mesh(std::size_t mesh, std::size_t primitive);
  std::uint32_t material(const tinygltf::Primitive& primitive);
  void add_instance(std::size_t node, std::uint32_t mesh, const tinygltf::Primitive& primitive);
  void add_object(std::size_t node);

  Document& document_;
  const NodeTree& tree_;
  Scene& scene_;
  /// By glTF mesh and primitive; no value: it has no triangles.
  std::map<std::pair<std::size_t, std::size_t>, std::optional<std::uint32_t>> meshes_;
  std::optional<std::uint32_t> default_material_;
};

std::optional<std::uint32_t> Builder::mesh(std::size_t mesh, std::size_t primitive) {
  const auto [it, is_new] = meshes_.try_emplace(std::pair(mesh, primitive));
  if (!is_new) return it->second;
  if (auto read = read_primitive(document_, mesh, primitive)) {
    it->second = static_cast<std::uint32_t>(scene_.meshes.size());
    scene_.meshes.push_back(std::move(*read));
  }
  return it->second;
}

std::uint32_t Builder::material(const tinygltf::Primitive& primitive) {
  if (primitive.material >= 0) return static_cast<std::uint32_t>(primitive.material);
  if (!default_material_) {
    default_material_ = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back(default_material());
    scene_.report.conversions.push_back("meshes without a material are shown matte grey");
  }
  return *default_material_;
}

void Builder::add_instance(std::size_t node, std::uint32_t mesh,
                           const tinygltf::Primitive& primitive) {
  Instance instance;
  instance.mesh = mesh;
  instance.material = material(primitive);
  if (is_cut_away(scene_.materials[instance.material]))
    return document_.warnings().add("a mesh whose material cuts all of it away is left out",
                                    node_name(document_, node));
  instance.object = static_cast<std::uint32_t>(scene_.objects.size() - 1);
  instance.world_from_mesh = tree_.world_from_node[node];
  scene_.instances.push_back(instance);
}

void Builder::add_object(std::size_t i) {
  const tinygltf::Node& node = document_.model().nodes[i];
  const std::string& mesh = document_.model().meshes[static_cast<std::size_t>(node.mesh)].name;
  const bool use_mesh = node.name.empty() && !mesh.empty();
  Object& object = scene_.objects.emplace_back();
  object.name = use_mesh ? mesh : node_name(document_, i);
  object.receives = flag(node.extras, "receives").value_or(true);
  object.samples_scale = samples_scale(document_, i);
}

void Builder::add_node(std::size_t i) {
  const tinygltf::Node& node = document_.model().nodes[i];
  if (node.mesh < 0) return;
  add_object(i);
  if (node.skin >= 0)
    document_.warnings().add("skins are left out: the mesh is shown as modelled",
                             node_name(document_, i));
  const auto index = static_cast<std::size_t>(node.mesh);
  const auto& primitives = document_.model().meshes[index].primitives;
  for (std::size_t k = 0; k < primitives.size(); ++k)
    if (const auto m = mesh(index, k)) add_instance(i, *m, primitives[k]);
}

}  // namespace
}  // namespace gltf

Scene read_gltf(const std::string& path, const LoadOptions& options) {
  gltf::Document document(path);
  const gltf::Motion motion = gltf::motion_at(document, options.time);
  const gltf::NodeTree tree = gltf::node_tree(document, motion.poses);
  gltf::check_instance_count(document, tree);
  Scene scene;
  scene.keyframe_times = motion.times;
  scene.report.format = document.json().source().binary() ? "glTF 2.0 (binary)" : "glTF 2.0 (text)";
  gltf::Textures textures(document);
  scene.materials = gltf::read_materials(document, textures);
  scene.textures = textures.decode();
  gltf::Builder builder(document, tree, scene);
  for (std::size_t i = 0; i < tree.in_scene.size(); ++i)
    if (tree.in_scene[i]) builder.add_node(i);
  scene.cameras = gltf::read_cameras(document, tree);
  scene.lights = gltf::read_lights(document, tree);
  gltf::read_display(document.json(), scene);
  scene.report.warnings = document.warnings().lines();
  return scene;
}

}  // namespace penumbra
