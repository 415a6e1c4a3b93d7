#include "bake/uv_overlap.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace penumbra::bake {
namespace {

constexpr float tolerance = 1.0f / 64;  // texels

struct Box {
  Vec2 lo{INFINITY, INFINITY}, hi{-INFINITY, -INFINITY};

  void grow(const Vec2& p) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
  }
};

Box box_of(const LaidTriangle& t) {
  Box box;
  for (const Vec2& p : t.corner) box.grow(p);
  return box;
}

struct Range {
  float lo = INFINITY, hi = -INFINITY;
};

Range along(const LaidTriangle& t, const Vec2& axis) {
  Range range;
  for (const Vec2& p : t.corner) {
    const float x = p.x * axis.x + p.y * axis.y;
    range = {std::min(range.lo, x), std::max(range.hi, x)};
  }
  return range;
}

/// True if a line along one of a's edges parts them.
bool is_parted(const LaidTriangle& a, const LaidTriangle& b) {
  for (int k = 0; k < 3; ++k) {
    const Vec2 &p = a.corner[k], &q = a.corner[(k + 1) % 3];
    const float size = std::hypot(q.x - p.x, q.y - p.y);
    if (!(size > 0)) continue;
    const Vec2 normal{(p.y - q.y) / size, (q.x - p.x) / size};
    const Range of_a = along(a, normal), of_b = along(b, normal);
    if (std::min(of_a.hi, of_b.hi) - std::max(of_a.lo, of_b.lo) <= tolerance) return true;
  }
  return false;
}

bool overlap(const LaidTriangle& a, const LaidTriangle& b) {
  return !is_parted(a, b) && !is_parted(b, a);
}

/// Triangles by the cells of a grid that their boxes touch.
class Grid {
 public:
  explicit Grid(std::span<const LaidTriangle> triangles) {
    for (const LaidTriangle& t : triangles)
      for (const Vec2& p : t.corner) bounds_.grow(p);
    side_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(triangles.size()))), 1, 1024);
    cells_.resize(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_));
  }

  template <class Visit>
  void for_cells(const LaidTriangle& t, const Visit& visit) {
    const Box box = box_of(t);
    const int x1 = cell(box.hi.x, bounds_.lo.x, bounds_.hi.x);
    const int y1 = cell(box.hi.y, bounds_.lo.y, bounds_.hi.y);
    for (int y = cell(box.lo.y, bounds_.lo.y, bounds_.hi.y); y <= y1; ++y)
      for (int x = cell(box.lo.x, bounds_.lo.x, bounds_.hi.x); x <= x1; ++x)
        visit(cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
                     static_cast<std::size_t>(x)]);
  }

 private:
  int cell(float v, float lo, float hi) const {
    if (!(hi > lo)) return 0;
    return std::clamp(static_cast<int>((v - lo) / (hi - lo) * static_cast<float>(side_)), 0,
                      side_ - 1);
  }

  Box bounds_;
  int side_ = 1;
  std::vector<std::vector<std::size_t>> cells_;
};

}  // namespace

std::optional<UvOverlap> find_overlap(std::span<const LaidTriangle> triangles, bool across) {
  if (triangles.empty()) return {};
  Grid grid(triangles);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    std::optional<UvOverlap> found;
    grid.for_cells(triangles[i], [&](std::vector<std::size_t>& cell) {
      for (const std::size_t other : cell) {
        if (found || (across && triangles[other].group == triangles[i].group)) continue;
        if (overlap(triangles[other], triangles[i])) found = UvOverlap{other, i};
      }
      cell.push_back(i);
    });
    if (found) return found;
  }
  return {};
}

}  // namespace penumbra::bake
