#include "geometry/cone_shaft.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

ConeBundle::ConeBundle(const ConeBatch& queries, std::size_t first, std::size_t count,
                       const Vec3& center) {
  Vec3 sum;
  for (std::size_t i = first; i < first + count; ++i) {
    sum += queries.vector(ConeBatch::direction, i);
    radius = std::max(radius, length(queries.vector(ConeBatch::origin, i) - center));
  }
  const float total = length(sum);
  if (!(total > 0)) return;
  axis = frame_around(sum / total);
  for (std::size_t i = first; i < first + count; ++i) {
    const Vec3 direction = queries.vector(ConeBatch::direction, i);
    const float outer = queries.column(ConeBatch::outer)[i];
    const float away = length(cross(direction, axis.w)), along = dot(direction, axis.w);
    // tan(a + b), b the cone's own half-angle.
    const float below = along - away * outer;
    if (!(below > 0.1f)) return;
    slope = std::max(slope, (away + along * outer) / below);
  }
  // Wider by some roundings.
  slope *= 1 + 0x1p-18f, radius *= 1 + 0x1p-18f;
  offset = radius * std::sqrt(1 + slope * slope);
  valid = true;
}

}  // namespace penumbra
