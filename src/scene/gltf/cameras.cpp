#include "scene/gltf/cameras.h"

#include <algorithm>
#include <numbers>

#include "scene/gltf/axes.h"
#include "scene/gltf/values.h"

namespace penumbra::gltf {
namespace {

void read_lens(const tinygltf::Camera& in, Camera& out) {
  if (in.type == "orthographic") {
    out.ortho_height = to_float(2 * std::max(std::abs(in.orthographic.ymag), 1e-30));
    return;
  }
  out.vertical_fov = to_float(std::min(in.perspective.yfov, 0.999 * std::numbers::pi));
}

Camera placed(const Axes& axes) {
  Camera camera;
  // As far as the camera is from the origin, so that rounding turns the view by no more than it
  // moves the position.
  const double far = std::max(1.0, length(axes.origin));
  camera.position = Vec3(axes.origin);
  camera.look_at = Vec3(axes.origin - axes.z * far);
  camera.up = Vec3(axes.y);
  return camera;
}

}  // namespace

std::vector<Camera> read_cameras(Document& document, const NodeTree& tree) {
  std::vector<Camera> cameras;
  const tinygltf::Model& model = document.model();
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (!tree.in_scene[i] || model.nodes[i].camera < 0) continue;
    const auto axes = axes_of(tree.world_from_node[i]);
    if (!axes) {
      document.warnings().add("a camera with a singular transform is left out",
                              node_name(document, i));
      continue;
    }
    const tinygltf::Camera& in = model.cameras[static_cast<std::size_t>(model.nodes[i].camera)];
    Camera& out = cameras.emplace_back(placed(*axes));
    out.name = in.name.empty() ? node_name(document, i) : in.name;
    read_lens(in, out);
  }
  return cameras;
}

}  // namespace penumbra::gltf
