#include "scene/extent.h"

#include <algorithm>

namespace penumbra {
namespace {

constexpr float unseen_half_side = 4;  // metres, about where nobody looks

bool has_no_end(const Bounds& box) { return !box.empty() && !is_finite(box); }

}  // namespace

bool is_bounded(const Scene& scene) {
  return !scene.glsl && std::ranges::none_of(scene.sdfs, [](const SdfTree& tree) {
    return has_no_end(bounds_of(tree));
  });
}

Bounds extent_of(const Scene& scene) {
  Bounds box = bounds_of(scene);
  if (is_bounded(scene)) return box;
  for (const Camera& camera : scene.cameras) {
    const Vec3 reach(std::max(length(camera.look_at - camera.position), 1e-6f));
    box.grow(Bounds{camera.look_at - reach, camera.look_at + reach});
  }
  if (box.empty()) return {Vec3(-unseen_half_side), Vec3(unseen_half_side)};
  return box;
}

Bounds sun_bounds(const Scene& scene) {
  const Bounds box = bounds_of(scene);
  return box.empty() ? extent_of(scene) : box;
}

std::optional<std::uint32_t> unbounded_node(const SdfTree& tree) {
  const std::vector<Bounds> boxes = bounds_of_nodes(tree);
  if (!has_no_end(boxes[0])) return {};
  for (std::uint32_t node = 0;;) {
    const SdfNode& n = tree.nodes[node];
    std::uint32_t child = 0;
    while (child < n.child_count && !has_no_end(boxes[n.first_child + child])) ++child;
    if (child == n.child_count) return node;
    node = n.first_child + child;
  }
}

}  // namespace penumbra
