// Which triangles are the receiver's own.
#pragma once

#include <algorithm>
#include <vector>

#include "bake/chart.h"
#include "geometry/hit.h"

namespace penumbra::bake {

/// The triangles that a chart consists of do not occlude it.
class OwnTriangles {
 public:
  explicit OwnTriangles(const PlanarChart& chart)
      : instance_(chart.triangles.empty() ? PrimitiveId::none : chart.instance),
        triangles_(chart.triangles) {
    std::sort(triangles_.begin(), triangles_.end());
  }
  /// The instance of all of them; PrimitiveId::none if there is none.
  std::uint32_t instance() const { return instance_; }
  bool contain(std::uint32_t triangle) const {
    return std::binary_search(triangles_.begin(), triangles_.end(), triangle);
  }

 private:
  std::uint32_t instance_;
  std::vector<std::uint32_t> triangles_;
};

}  // namespace penumbra::bake
