// What rasterisers are held against other ways on: triangles, spheres and holes that cross the
// planes of receiver and light. Receivers are instance 0.
#pragma once

#include <random>

#include "bake/charts.h"
#include "bake/light_sampler.h"
#include "render/small_scenes.h"

namespace penumbra::bake {

inline void add_triangle(Scene& scene, const Vec3& a, const Vec3& b, const Vec3& c) {
  Mesh mesh;
  mesh.positions = {a, b, c};
  mesh.indices = {0, 1, 2};
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  scene.meshes.push_back(mesh);
  scene.instances.push_back(instance);
}

inline ReceiverPatch patch_of(const PlanarChart& c) {
  return {
      {c.base, c.base + c.edge_x, c.base + c.edge_x + c.edge_y, c.base + c.edge_y}, c.normal, 1};
}

inline Light light_of(LightType type) {
  Light light;
  light.type = type;
  light.position = {0.4f, 3, 0.2f};
  light.normal = normalize(Vec3{-0.2f, -1, 0.1f});
  const Frame f = frame_around(light.normal);
  light.edge_u = f.u * 0.8f, light.edge_v = f.v * -0.6f;
  if (type == LightType::segment) light.edge_u = {0.6f, 0.2f, 0.3f};
  light.radius = type == LightType::segment ? 0.01f : 0.3f;
  light.direction = normalize(Vec3{-0.5f, -0.8f, 0.2f});
  light.angular_diameter = 0.1f;
  light.emission = Vec3(1);
  return light;
}

inline Scene triangles_across_all_planes(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-2, 2), height(-0.8f, 4), size(-0.8f, 0.8f);
  Scene scene;
  const auto grey = add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f}));
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0.4f, 0, -4}, grey);
  for (int i = 0; i < 60; ++i) {
    const Vec3 a{place(random), height(random), place(random)};
    add_triangle(scene, a, a + Vec3{size(random), size(random), size(random)},
                 a + Vec3{size(random), size(random), size(random)});
  }
  return scene;
}

inline Scene walls_on_the_receiver() {
  Scene scene;
  const auto grey = add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f}));
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, grey);
  add_quad(scene, {-1, 0, -0.5f}, {1.5f, 0, 0.2f}, {0, 1, 0}, grey);
  add_quad(scene, {0.5f, -1, -2}, {0, 0, 4}, {0.5f, 5, 0}, grey);
  add_quad(scene, {-9, 0, 0.9f}, {18, 0, 0}, {0, 0.4f, 0}, grey);
  return scene;
}

inline Scene spheres_all_round() {
  Scene scene;
  const auto grey = add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f}));
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, grey);
  add_sphere(scene, {0.2f, 0.8f, 0.1f}, 0.4f, grey);
  add_sphere(scene, {-1, 0.1f, 0.8f}, 0.5f, grey);
  add_sphere(scene, {-1, -0.2f, -0.8f}, 0.5f, grey);
  add_sphere(scene, {1.2f, -0.6f, -0.5f}, 0.5f, grey);
  add_sphere(scene, {1.4f, 3.1f, 0.4f}, 0.5f, grey);
  return scene;
}

/// Front, or a whole box, as a light of its own.
inline Scene lit_by_mesh(bool box, bool double_sided) {
  Scene scene;
  const auto grey = add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f}));
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, grey);
  add_triangle(scene, {-1, 1, -0.5f}, {0.8f, 1.2f, 0.1f}, {0.1f, 0.4f, 1});
  // A ceiling in the plane of the light's lower face, and one through its middle.
  add_quad(scene, {-2, 2, -2}, {1.8f, 0, 0}, {0, 0, 4}, grey);
  add_quad(scene, {0.6f, 2.1f, -2}, {1, 0, 0}, {0, 0, 4}, grey);
  Mesh mesh;
  mesh.positions = {{-0.2f, 2, -0.2f},  {0.4f, 2, -0.2f},     {0.4f, 2, 0.3f},
                    {-0.2f, 2, 0.3f},   {-0.2f, 2.3f, -0.2f}, {0.4f, 2.3f, -0.2f},
                    {0.4f, 2.3f, 0.3f}, {-0.2f, 2.3f, 0.3f}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  if (box)
    mesh.indices = {0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6, 0, 5, 1, 0, 4, 5,
                    2, 7, 3, 2, 6, 7, 0, 3, 7, 0, 7, 4, 1, 6, 2, 1, 5, 6};
  Light light;
  light.type = LightType::mesh;
  light.instance = static_cast<int>(scene.instances.size());
  light.emission = Vec3(1);
  light.double_sided = double_sided;
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  instance.mesh_light = 0;
  scene.meshes.push_back(mesh);
  scene.instances.push_back(instance);
  scene.lights.push_back(light);
  return scene;
}

inline Scene leaves_with_holes() {
  Scene scene;
  const auto grey = add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f}));
  TextureImage image;
  image.width = image.height = 16;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      for (const int value : {255, 255, 255, (x / 3 + y / 5) % 2 * 255})
        image.rgba.push_back(static_cast<std::uint8_t>(value));
  scene.textures.push_back(image);
  Material leaf = diffuse_material({0.1f, 0.7f, 0.1f});
  leaf.alpha_cutoff = 0.5f;
  leaf.diffuse_map.image = 0;
  const auto green = add_material(scene, leaf);
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, grey);
  add_quad(scene, {-1, 0.8f, 0.7f}, {1.9f, 0.3f, 0}, {0, 0.2f, -1.6f}, green);
  add_quad(scene, {-1.5f, -0.4f, 0.9f}, {0, 0, -1.6f}, {0.2f, 1.1f, 0}, green);
  return scene;
}

/// Boxes that reach through the receiver, some inside out; with `shade` one that holds the light.
inline Scene closed_surfaces(bool shade) {
  Scene scene;
  const auto grey = add_material(scene, diffuse_material({0.8f, 0.8f, 0.8f}));
  add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, grey);
  const auto add_box = [&](const Vec3& lo, const Vec3& hi, bool inside_out) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
      mesh.positions.push_back({i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z});
    mesh.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    if (inside_out)
      for (std::size_t t = 0; t < mesh.indices.size(); t += 3)
        std::swap(mesh.indices[t], mesh.indices[t + 1]);
    Instance instance;
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back(mesh);
    scene.instances.push_back(instance);
  };
  add_box({-1, -0.3f, -1}, {-0.5f, 0.5f, -0.3f}, false);
  add_box({0.2f, -0.3f, -0.9f}, {0.7f, 0.6f, -0.2f}, true);
  add_box({-0.9f, 0.3f, 0.3f}, {-0.1f, 0.6f, 0.9f}, true);
  add_box({0.6f, 0, 0.4f}, {1.1f, 0.5f, 1}, false);
  if (shade) {
    // Without a floor, and open: the light shines out of it from below.
    add_box({0, 2.6f, -0.2f}, {0.8f, 3.4f, 0.6f}, false);
    scene.meshes.back().indices.resize(30);
  }
  scene.lights.push_back(light_of(LightType::sphere));
  return scene;
}

}  // namespace penumbra::bake
