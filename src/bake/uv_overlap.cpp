#include "bake/uv_overlap.h"

#include <algorithm>
#include <cmath>

namespace penumbra::bake {
namespace {

constexpr float clear = 1.0f / 64;  // texels
constexpr std::uint32_t several = 1u << 31;

/// The inner side of a triangle's edge: distance(p) is in texels.
struct Side {
  Vec2 normal;
  float offset = 0;

  float distance(const Vec2& p) const { return normal.x * p.x + normal.y * p.y - offset; }
};

/// False for a triangle without area.
bool sides_of(const LaidTriangle& t, Side (&sides)[3]) {
  const auto& [a, b, c] = t.corner;
  const float doubled = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  const float turn = doubled < 0 ? -1.0f : 1.0f;
  for (int k = 0; k < 3; ++k) {
    const Vec2 &p = t.corner[k], &q = t.corner[(k + 1) % 3];
    const float size = std::hypot(q.x - p.x, q.y - p.y);
    if (!(size > 0)) return false;
    sides[k].normal = {turn * (p.y - q.y) / size, turn * (q.x - p.x) / size};
    sides[k].offset = sides[k].normal.x * p.x + sides[k].normal.y * p.y;
  }
  return doubled != 0;
}

}  // namespace

ClaimedTexels::ClaimedTexels(int width, int height)
    : width_(width),
      height_(height),
      owner_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

void ClaimedTexels::add(std::span<const LaidTriangle> triangles) {
  for (const LaidTriangle& t : triangles) {
    const std::size_t number = count_++;
    Side sides[3];
    if (!sides_of(t, sides)) continue;
    const auto [x0, x1] = std::minmax({t.corner[0].x, t.corner[1].x, t.corner[2].x});
    const auto [y0, y1] = std::minmax({t.corner[0].y, t.corner[1].y, t.corner[2].y});
    const auto first = [](float v) { return std::max(0, static_cast<int>(std::ceil(v - 0.5f))); };
    const auto last = [](float v, int n) {
      return std::min(n - 1, static_cast<int>(std::floor(v - 0.5f)));
    };
    for (int y = first(y0); y <= last(y1, height_); ++y)
      for (int x = first(x0); x <= last(x1, width_); ++x) {
        const Vec2 p{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
        if (std::ranges::any_of(sides, [&](const Side& s) { return s.distance(p) < clear; }))
          continue;
        std::uint32_t& owner =
            owner_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x)];
        if (owner == 0) {
          owner = static_cast<std::uint32_t>(number + 1);
          ++overlap_.covered;
        } else if ((owner & several) == 0) {
          if (overlap_.contested++ == 0) overlap_.a = owner - 1, overlap_.b = number;
          owner |= several;
        }
      }
  }
}

}  // namespace penumbra::bake
