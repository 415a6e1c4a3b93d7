// The grids of meshes as texels for mesh.glsl. Internal to the room.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sdf/mesh_grid.h"

namespace penumbra::sdf {

class MeshTexels {
 public:
  /// Writes the grid, once for all its instances. Gives a pnb_Grid as GLSL.
  std::string add(const MeshGrid& grid);
  /// Four floats a texel.
  std::vector<float> take() { return std::move(texels_); }

 private:
  /// Returns the number of the first texel.
  int append(const std::vector<float>& numbers);

  std::vector<float> texels_;
  std::map<const MeshGrid*, std::string> written_;
};

}  // namespace penumbra::sdf
