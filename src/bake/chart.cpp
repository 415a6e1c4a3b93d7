#include "bake/chart.h"

namespace penumbra::bake {

Vec3 PlanarChart::texel(float i, float j) const {
  return base + edge_x * ((i + 0.5f) / static_cast<float>(width)) +
         edge_y * ((j + 0.5f) / static_cast<float>(height));
}

}  // namespace penumbra::bake
