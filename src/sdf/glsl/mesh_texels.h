// The grids of meshes as texels for mesh.glsl. Internal to the room.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "scene/scene.h"
#include "sdf/mesh_distance.h"
#include "sdf/mesh_grid.h"

namespace penumbra::sdf {

class TriangleTree;

class MeshTexels {
 public:
  /// Writes an instance of the scene, and what its grid has, once for all instances of that.
  void add(const Scene& scene, std::size_t instance, const MeshDistance::Placed& placed);
  /// Writes an instance that has a formula for its distances: only its triangles.
  void add_triangles(const Scene& scene, std::size_t instance);
  bool empty() const { return records_.empty(); }
  /// Writes the instances' records. Returns the number of the texel that they follow.
  int finish();
  /// Four floats a texel.
  std::vector<float> take() { return std::move(texels_); }

 private:
  /// Four texels: the last of an instance's record.
  using GridRecord = std::array<float, 16>;

  void add_record(const Instance& instance, std::size_t number, const Affine& from_world,
                  double scale, const GridRecord& grid);
  void write_mesh(const TriangleTree& triangles, const Mesh& mesh, bool turned_round,
                  GridRecord& r);
  GridRecord write(const MeshGrid& grid, const Mesh& mesh, bool turned_round);
  /// Returns the number of the first texel, a multiple of 4: so floats hold it up to 2^26.
  float append(const std::vector<float>& numbers);

  std::vector<float> texels_, records_;
  std::map<const MeshGrid*, GridRecord> written_;
};

}  // namespace penumbra::sdf
