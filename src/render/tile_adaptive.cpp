#include "render/tile_adaptive.h"

#include <algorithm>

#include "shadow/adaptive_area.h"

namespace penumbra {
namespace {

using First = AdaptiveArea::First;
using Verdict = AdaptiveArea::Verdict;

/// First answers by pixel of the tile, with a border of the unknown.
class VerdictMap {
 public:
  VerdictMap(int width, std::uint32_t last_pixel)
      : width_(width),
        height_(static_cast<int>(last_pixel) / width + 1),
        known_(static_cast<std::size_t>(width_) * height_, absent) {}

  void set(std::uint32_t pixel, Verdict verdict) {
    known_[pixel] = static_cast<std::uint8_t>(verdict);
  }

  /// Whether any pixel next to `pixel` has another answer, or lies in another tile.
  bool neighbour_disagrees(std::uint32_t pixel) const {
    const int x = static_cast<int>(pixel) % width_, y = static_cast<int>(pixel) / width_;
    if (x == 0 || y == 0 || x == width_ - 1 || y == height_ - 1) return true;
    const std::uint8_t own = known_[pixel];
    for (int v = y - 1; v <= y + 1; ++v)
      for (int u = x - 1; u <= x + 1; ++u) {
        const std::uint8_t other = known_[static_cast<std::size_t>(v) * width_ + u];
        if (other != own && other != absent) return true;
      }
    return false;
  }

 private:
  static constexpr std::uint8_t absent = 0xff;  // background, or turned away from the light
  int width_, height_;
  std::vector<std::uint8_t> known_;
};

}  // namespace

void adaptive_visibility(const Shadows& shadows, std::size_t light,
                         std::span<const TilePoint> points, std::span<const std::uint8_t> asked,
                         int tile_width, std::span<LightArrival> arrivals,
                         std::vector<LightPoint>& scratch, ShadowCounts& counts) {
  if (points.empty()) return;
  const AdaptiveArea& area = *shadows.adaptive();
  thread_local std::vector<First> first;
  first.resize(points.size());
  std::uint32_t last_pixel = 0;
  for (const TilePoint& p : points) last_pixel = std::max(last_pixel, p.pixel);
  VerdictMap verdicts(tile_width, last_pixel);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!asked[i]) continue;
    first[i] = area.first(points[i].receiver, light, points[i].stream, counts);
    verdicts.set(points[i].pixel, first[i].verdict);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!asked[i]) continue;
    const Visibility seen =
        area.finish(points[i].receiver, light, points[i].stream, first[i],
                    verdicts.neighbour_disagrees(points[i].pixel), &scratch, counts);
    arrivals[i] = arrival_of(seen, scratch, points[i].shading);
  }
}

}  // namespace penumbra
