#include "bake/chart.h"

#include <algorithm>

#include "base/cancel.h"

namespace penumbra::bake {

Vec3 PlanarChart::texel(float i, float j) const {
  return base + edge_x * ((i + 0.5f) / static_cast<float>(width)) +
         edge_y * ((j + 0.5f) / static_cast<float>(height));
}

void Irradiance::of_curved(const PlanarChart&, std::span<const SurfacePoint> points,
                           std::span<const std::size_t>, std::span<Vec3> out) const {
  constexpr std::size_t batch = 16384;
  for (std::size_t first = 0; first < points.size(); first += batch) {
    throw_if_cancelled();
    const std::size_t count = std::min(batch, points.size() - first);
    of_points(points.subspan(first, count), out.subspan(first, count));
  }
}

}  // namespace penumbra::bake
