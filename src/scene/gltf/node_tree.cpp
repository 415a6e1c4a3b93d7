#include "scene/gltf/node_tree.h"

#include <fmt/format.h>

namespace penumbra::gltf {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);
constexpr const char* kRemedy = "correct the hierarchy or export the file again";

Vec3d vec3(const std::vector<double>& v, const Vec3d& otherwise) {
  return v.size() == 3 ? Vec3d{v[0], v[1], v[2]} : otherwise;
}

/// What the pose says, else the node.
const std::vector<double>& posed(const std::vector<double>& in_pose,
                                 const std::vector<double>& in_node) {
  return in_pose.empty() ? in_node : in_pose;
}

/// The columns of the rotation by a quaternion (x, y, z, w), which need not be of unit length.
Affine rotation(const std::vector<double>& q) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  const double norm = x * x + y * y + z * z + w * w;
  if (!(norm > 0)) return {};
  const double s = 2 / norm;
  return {{1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
          {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)},
          {s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)},
          {}};
}

Affine parent_from_node(const tinygltf::Node& node, const Pose& pose) {
  if (const auto& m = node.matrix; m.size() == 16)
    return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
  const std::vector<double>& quaternion = posed(pose.rotation, node.rotation);
  Affine a = quaternion.size() == 4 ? rotation(quaternion) : Affine{};
  const Vec3d scale = vec3(posed(pose.scale, node.scale), {1, 1, 1});
  a.x *= scale.x;
  a.y *= scale.y;
  a.z *= scale.z;
  a.t = vec3(posed(pose.translation, node.translation), {0, 0, 0});
  return a;
}

std::vector<std::size_t> parents(const Document& document) {
  const auto& nodes = document.model().nodes;
  std::vector<std::size_t> parent(nodes.size(), kNone);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t k = 0; k < nodes[i].children.size(); ++k) {
      const auto child = static_cast<std::size_t>(nodes[i].children[k]);
      if (parent[child] != kNone)
        throw document.json().error(fmt::format("nodes[{}].children[{}]", i, k),
                                    fmt::format("nodes[{}] has two parents", child), kRemedy);
      parent[child] = i;
    }
  return parent;
}

/// Where each node has at most one parent, what no root reaches lies on a cycle or below one:
/// as many steps up as there are nodes end on the cycle itself.
[[noreturn]] void fail_cycle(const Document& document, const std::vector<std::size_t>& parent,
                             std::size_t node) {
  for (std::size_t i = 0; i < parent.size(); ++i) node = parent[node];
  throw document.json().error(fmt::format("nodes[{}]", node), "it is its own ancestor", kRemedy);
}

/// All nodes, parents before children.
std::vector<std::size_t> top_down(const Document& document,
                                  const std::vector<std::size_t>& parent) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < parent.size(); ++i)
    if (parent[i] == kNone) order.push_back(i);
  for (std::size_t k = 0; k < order.size(); ++k)
    for (const int child : document.model().nodes[order[k]].children)
      order.push_back(static_cast<std::size_t>(child));
  if (order.size() == parent.size()) return order;
  std::vector<char> reached(parent.size(), 0);
  for (const std::size_t i : order) reached[i] = 1;
  std::size_t lost = 0;
  while (reached[lost]) ++lost;
  fail_cycle(document, parent, lost);
}

std::vector<char> scene_roots(const Document& document, const std::vector<std::size_t>& parent) {
  const tinygltf::Model& model = document.model();
  if (model.scenes.empty()) return std::vector<char>(parent.size(), 1);
  const auto shown = static_cast<std::size_t>(std::max(0, model.defaultScene));
  std::vector<char> in_scene(parent.size(), 0);
  const std::vector<int>& roots = model.scenes[shown].nodes;
  for (std::size_t k = 0; k < roots.size(); ++k) {
    const auto root = static_cast<std::size_t>(roots[k]);
    if (parent[root] != kNone)
      throw document.json().error(
          fmt::format("scenes[{}].nodes[{}]", shown, k),
          fmt::format("nodes[{}] is no root: it is a child of nodes[{}]", root, parent[root]),
          kRemedy);
    in_scene[root] = 1;
  }
  return in_scene;
}

}  // namespace

NodeTree node_tree(const Document& document, const Poses& poses) {
  const std::vector<std::size_t> parent = parents(document);
  const std::vector<std::size_t> order = top_down(document, parent);
  NodeTree tree;
  tree.in_scene = scene_roots(document, parent);
  tree.world_from_node.resize(parent.size());
  for (const std::size_t i : order) {
    const auto pose = poses.find(i);
    const Affine local =
        parent_from_node(document.model().nodes[i], pose == poses.end() ? Pose{} : pose->second);
    if (parent[i] == kNone) {
      tree.world_from_node[i] = local;
    } else {
      tree.world_from_node[i] = tree.world_from_node[parent[i]] * local;
      tree.in_scene[i] = tree.in_scene[parent[i]];
    }
  }
  return tree;
}

std::string node_name(const Document& document, std::size_t node) {
  const std::string& name = document.model().nodes[node].name;
  return name.empty() ? fmt::format("node {}", node) : name;
}

}  // namespace penumbra::gltf
