// Scenes and light for tests of charts and files.
#pragma once

#include <cmath>

#include "bake/chart.h"
#include "scene/finish.h"

namespace penumbra::test {

/// Adds a mesh with an object, an instance and a material of its own; returns the instance.
inline std::uint32_t add_mesh(Scene& scene, const std::vector<Vec3>& positions,
                              const std::vector<std::uint32_t>& indices) {
  Mesh mesh;
  mesh.positions = positions;
  mesh.indices = indices;
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  instance.material = static_cast<std::uint32_t>(scene.materials.size());
  instance.object = static_cast<std::uint32_t>(scene.objects.size());
  scene.meshes.push_back(mesh);
  scene.materials.emplace_back().double_sided = false;
  scene.objects.push_back({"object " + std::to_string(instance.object), true});
  scene.instances.push_back(instance);
  return static_cast<std::uint32_t>(scene.instances.size()) - 1;
}

inline std::uint32_t add_quad(Scene& scene, const Vec3& corner, const Vec3& u, const Vec3& v) {
  return add_mesh(scene, {corner, corner + u, corner + u + v, corner + v}, {0, 1, 2, 0, 2, 3});
}

/// [−1, 1]³, its faces outwards, with vertices of its own for each face.
inline std::uint32_t add_cube(Scene& scene) {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> indices;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      Vec3 n, u, v;
      n[axis] = side, u[(axis + 1) % 3] = side, v[(axis + 2) % 3] = 1;
      const auto first = static_cast<std::uint32_t>(positions.size());
      for (const Vec3& p : {n - u - v, n + u - v, n + u + v, n - u + v}) positions.push_back(p);
      for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) indices.push_back(first + k);
    }
  return add_mesh(scene, positions, indices);
}

/// A known field of irradiance, the same for charts and points.
class FieldIrradiance : public bake::Irradiance {
 public:
  using Function = Vec3 (*)(const Vec3& position);
  explicit FieldIrradiance(Function f) : f_(f) {}

  void of_chart(const bake::PlanarChart& chart, std::span<Vec3> out) const override {
    for (int j = 0; j < chart.height; ++j)
      for (int i = 0; i < chart.width; ++i)
        out[static_cast<std::size_t>(j) * static_cast<std::size_t>(chart.width) +
            static_cast<std::size_t>(i)] =
            f_(chart.texel(static_cast<float>(i), static_cast<float>(j)));
  }
  void of_points(std::span<const bake::SurfacePoint> points, std::span<Vec3> out) const override {
    for (std::size_t i = 0; i < points.size(); ++i) out[i] = f_(points[i].position);
  }

 private:
  Function f_;
};

}  // namespace penumbra::test
