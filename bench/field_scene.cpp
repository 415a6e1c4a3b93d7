#include "field_scene.h"

#include <cmath>
#include <numbers>
#include <random>

#include "scene/finish.h"

namespace penumbra::bench {
namespace {

void add_node(SdfTree& tree, SdfOp op, std::initializer_list<double> numbers) {
  SdfNode node;
  node.op = op;
  node.first_number = static_cast<std::uint32_t>(tree.numbers.size());
  node.number_count = static_cast<std::uint32_t>(numbers.size());
  tree.numbers.insert(tree.numbers.end(), numbers);
  tree.nodes.push_back(node);
}

void add_shapes(SdfTree& tree, int count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-1, 1);
  const double size = 2.2 / std::sqrt(double(count));
  for (int i = 1; i < count; ++i) {
    const double x = 3 * u(random), z = 3 * u(random), r = size * (0.3 + 0.1 * u(random));
    const double y = r * (1 + 0.5 * (1 + u(random)));
    if (i % 3 == 0) add_node(tree, SdfOp::box, {x, y, z, r, r * 0.8, r * 0.6});
    if (i % 3 == 1) add_node(tree, SdfOp::sphere, {x, y, z, r});
    if (i % 3 == 2) add_node(tree, SdfOp::torus, {x, y, z, r, r * 0.3});
  }
}

}  // namespace

Scene field_scene(int count, bool smooth) {
  Scene scene;
  scene.objects.push_back({"field"});
  scene.materials.emplace_back();
  SdfTree tree;
  if (smooth)
    add_node(tree, SdfOp::smooth_union, {0.05});
  else
    add_node(tree, SdfOp::union_, {});
  tree.nodes[0].first_child = 1;
  tree.nodes[0].child_count = static_cast<std::uint32_t>(count);
  add_node(tree, SdfOp::plane, {0, 1, 0, 0});
  add_shapes(tree, count);
  scene.sdfs.push_back(std::move(tree));
  Camera camera;
  camera.position = {0, 4, 7};
  camera.look_at = {0, 0.2f, 0};
  camera.vertical_fov = 40 * std::numbers::pi_v<float> / 180;
  scene.cameras.push_back(camera);
  Light light;
  light.type = LightType::sphere;
  light.position = {3, 6, 2};
  light.radius = 0.35f;
  light.emission = Vec3(40);
  scene.lights.push_back(light);
  scene.ambient = Vec3(0.05f);
  scene.background = {0.6f, 0.7f, 0.9f};
  finish_scene(scene, "field");
  return scene;
}

}  // namespace penumbra::bench
