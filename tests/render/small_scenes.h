// Scenes of a few surfaces, built in code.
#pragma once

#include "scene/scene.h"

namespace penumbra {

inline Material diffuse_material(const Vec3& albedo) {
  Material material;
  material.diffuse = albedo;
  return material;
}

inline std::uint32_t add_material(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

/// A parallelogram whose front is the side of edge u × edge v.
inline void add_quad(Scene& scene, const Vec3& corner, const Vec3& u, const Vec3& v,
                     std::uint32_t material) {
  Mesh mesh;
  mesh.positions = {corner, corner + u, corner + u + v, corner + v};
  mesh.uv[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  instance.material = material;
  instance.object = static_cast<std::uint32_t>(scene.objects.size());
  scene.meshes.push_back(mesh);
  scene.instances.push_back(instance);
  scene.objects.push_back({"quad"});
}

inline void add_sphere(Scene& scene, const Vec3& center, float radius, std::uint32_t material) {
  const auto object = static_cast<std::uint32_t>(scene.objects.size());
  scene.spheres.push_back({center, radius, material, object});
  scene.objects.push_back({"sphere"});
}

inline void add_camera(Scene& scene, const Vec3& from, const Vec3& to, float vertical_fov) {
  Camera camera;
  camera.position = from;
  camera.look_at = to;
  camera.vertical_fov = vertical_fov;
  scene.cameras.push_back(camera);
}

inline void add_sphere_light(Scene& scene, const Vec3& at, float radius, float radiance) {
  Light light;
  light.type = LightType::sphere;
  light.position = at;
  light.radius = radius;
  light.emission = Vec3(radiance);
  scene.lights.push_back(light);
}

/// A floor of side 8 on y = 0 under the origin.
inline void add_floor(Scene& scene, std::uint32_t material) {
  add_quad(scene, {-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, material);
}

/// Three spheres of different kinds on a floor under a sphere light.
inline Scene still_life(float scale = 1) {
  Scene scene;
  const auto floor = add_material(scene, diffuse_material({0.8f, 0.7f, 0.6f}));
  const auto clay = add_material(scene, diffuse_material({0.7f, 0.5f, 0.4f}));
  Material chrome = diffuse_material({0, 0, 0}), glazed = diffuse_material({0.2f, 0.3f, 0.6f});
  chrome.mirror = Vec3(0.9f);
  glazed.specular = Vec3(0.05f);
  glazed.roughness = 0.3f;
  add_quad(scene, Vec3{-4, 0, 4} * scale, Vec3{8, 0, 0} * scale, Vec3{0, 0, -8} * scale, floor);
  add_sphere(scene, Vec3{0, 0.5f, 0} * scale, 0.5f * scale, clay);
  add_sphere(scene, Vec3{1.2f, 0.35f, 0.4f} * scale, 0.35f * scale, add_material(scene, chrome));
  add_sphere(scene, Vec3{-1.1f, 0.4f, 0.3f} * scale, 0.4f * scale, add_material(scene, glazed));
  add_sphere_light(scene, Vec3{1.4f, 3.5f, 0.6f} * scale, 0.35f * scale, 20);
  add_camera(scene, Vec3{3.2f, 2.6f, 4.4f} * scale, Vec3{0, 0.4f, 0} * scale, 0.7f);
  scene.background = {0.2f, 0.3f, 0.5f};
  return scene;
}

}  // namespace penumbra
