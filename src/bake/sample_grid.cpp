#include "bake/sample_grid.h"

#include <algorithm>

#include "render/pixel_samples.h"
#include "shadow/light_samples.h"

namespace penumbra::bake {
namespace {

float unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

// Cells in pairs, of which one is jittered as the other's mirror image: what a pair gets wrong of a
// smooth function cancels but for the function's bend.
Vec2 place_in_cell(SamplePlacement placement, std::uint64_t seed, int cell) {
  if (placement == SamplePlacement::regular) return {0.5f, 0.5f};
  const std::uint64_t h = hash(seed, static_cast<std::uint64_t>(cell / 2) + 1);
  const Vec2 p{unit(static_cast<std::uint32_t>(h)), unit(static_cast<std::uint32_t>(h >> 32))};
  return cell % 2 == 0 ? p : Vec2{1 - p.x, 1 - p.y};
}

std::vector<Vec2> in_cells(int count, float aspect, SamplePlacement placement, std::uint64_t seed) {
  const float n = static_cast<float>(count);
  const int rows = std::clamp(static_cast<int>(std::lround(std::sqrt(n / aspect))), 1, count);
  std::vector<Vec2> points;
  points.reserve(count);
  for (int row = 0, first = 0; row < rows; ++row) {
    const auto last = static_cast<int>(std::int64_t{count} * (row + 1) / rows);
    const float columns = static_cast<float>(last - first), y = static_cast<float>(first) / n;
    for (int i = first; i < last; ++i) {
      const Vec2 p = place_in_cell(placement, seed, i);
      points.push_back({(static_cast<float>(i - first) + p.x) / columns, y + p.y * columns / n});
    }
    first = last;
  }
  return points;
}

std::uint32_t spread(float unit_coordinate) {
  auto x = static_cast<std::uint32_t>(std::clamp(unit_coordinate, 0.0f, 1.0f) * 255);
  x = (x | x << 4) & 0x0f0fu;
  x = (x | x << 2) & 0x3333u;
  return (x | x << 1) & 0x5555u;
}

std::uint32_t morton(const Vec2& p) { return spread(p.x) | spread(p.y) << 1; }

}  // namespace

std::vector<Vec2> sample_grid(int count, float aspect, SamplePlacement placement,
                              std::uint64_t seed) {
  std::vector<Vec2> points;
  if (placement == SamplePlacement::low_discrepancy) {
    for (int i = 0; i < count; ++i) points.push_back(pixel_sample(i, count));
  } else {
    points = in_cells(count, aspect, placement, seed);
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const Vec2& a, const Vec2& b) { return morton(a) < morton(b); });
  return points;
}

}  // namespace penumbra::bake
