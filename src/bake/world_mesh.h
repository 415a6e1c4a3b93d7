// One instance of a scene in the world's frame, triangle by triangle.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace penumbra::bake {

/// Corners are numbered 0 to 2, counter-clockwise seen from the front in the world's frame, also
/// where the instance is mirrored.
class WorldMesh {
 public:
  /// Keeps a reference to the scene.
  WorldMesh(const Scene& scene, std::uint32_t instance);

  std::size_t triangle_count() const { return mesh_.triangle_count(); }
  /// Of corner k: its place in the mesh's arrays, its position (metres) and its unit normal, that
  /// of the triangle where the mesh has none.
  std::uint32_t vertex(std::uint32_t triangle, int k) const;
  const Vec3& corner(std::uint32_t triangle, int k) const {
    return positions_[vertex(triangle, k)];
  }
  Vec3 corner_normal(std::uint32_t triangle, int k) const;

  /// Unit, of the front; and the area, m².
  const Vec3& normal(std::uint32_t triangle) const { return normals_[triangle]; }
  float area(std::uint32_t triangle) const { return areas_[triangle]; }
  /// True if a vertex normal differs from the triangle's by more than 0.06 degrees.
  bool is_smooth(std::uint32_t triangle) const;

  const Mesh& mesh() const { return mesh_; }
  const Instance& instance() const { return instance_; }
  std::uint32_t index() const { return index_; }
  const std::vector<Vec3>& positions() const { return positions_; }  ///< by vertex, world

 private:
  const Mesh& mesh_;
  const Instance& instance_;
  std::uint32_t index_;
  bool mirrored_;
  std::vector<Vec3> positions_, vertex_normals_;
  std::vector<Vec3> normals_;  ///< by triangle
  std::vector<float> areas_;
};

}  // namespace penumbra::bake
