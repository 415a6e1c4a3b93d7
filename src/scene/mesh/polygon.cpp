#include "scene/mesh/polygon.h"

#include <algorithm>

namespace penumbra {
namespace {

struct Point {
  double x, y;
  friend bool operator==(const Point&, const Point&) = default;
};

/// Twice the signed area; positive for a counter-clockwise turn.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Newell's normal: robust for concave and slightly bent polygons.
Vec3d newell_normal(std::span<const Vec3> polygon) {
  Vec3d n;
  const Vec3d origin(polygon[0]);
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    n += cross(Vec3d(polygon[i]) - origin, Vec3d(polygon[i + 1]) - origin);
  return n;
}

/// Drops the dominant coordinate of the normal so that the outline turns counter-clockwise.
std::vector<Point> project(std::span<const Vec3> polygon) {
  const Vec3d n = newell_normal(polygon), size = abs(n);
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (n[axis] < 0) std::swap(u, v);
  std::vector<Point> points;
  points.reserve(polygon.size());
  for (const Vec3& p : polygon) points.push_back({p[u], p[v]});
  return points;
}

/// Clips ears of a ring of corners.
class EarClipper {
 public:
  EarClipper(std::vector<Point> points, std::vector<std::uint32_t>& triangles)
      : points_(std::move(points)), triangles_(triangles) {
    const auto n = static_cast<std::uint32_t>(points_.size());
    next_.resize(n), previous_.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) next_[i] = (i + 1) % n, previous_[(i + 1) % n] = i;
    for (std::uint32_t i = 0; i < n; ++i)
      if (corner_turn(i) <= 0) reflex_.push_back(i);
    budget_ = points_.size() * 8192;
  }

  void run() {
    if (reflex_.empty() && turns_once()) return fan(0);
    std::uint32_t at = 0, left = static_cast<std::uint32_t>(points_.size()), tried = 0;
    while (left > 3) {
      if (tried >= left || budget_ == 0) return fan(at);
      if (is_ear(at)) {
        at = clip(at);
        --left, tried = 0;
      } else {
        at = next_[at];
        ++tried;
      }
    }
    fan(at);
  }

 private:
  double corner_turn(std::uint32_t i) const {
    return turn(points_[previous_[i]], points_[i], points_[next_[i]]);
  }

  /// A ring without reflex corners is convex unless it winds around more than once: then its
  /// direction changes sign along x more than twice.
  bool turns_once() const {
    int changes = 0;
    const auto goes_right = [&](std::uint32_t i) { return points_[next_[i]].x > points_[i].x; };
    for (std::uint32_t i = 0; i < points_.size(); ++i)
      changes += goes_right(i) != goes_right(next_[i]);
    return changes <= 2;
  }

  bool is_ear(std::uint32_t i) {
    const Point &a = points_[previous_[i]], &b = points_[i], &c = points_[next_[i]];
    if (!(turn(a, b, c) > 0)) return false;
    drop_healed_corners();
    budget_ -= std::min(budget_, reflex_.size());
    for (const std::uint32_t r : reflex_) {
      const Point& p = points_[r];
      if (p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  /// A corner that stopped being reflex never is again; clipped ones are marked by next = self.
  void drop_healed_corners() {
    if (!stale_) return;
    std::erase_if(reflex_, [&](std::uint32_t i) { return next_[i] == i || corner_turn(i) > 0; });
    stale_ = false;
  }

  /// Returns the corner after it: going on there, not before, makes fewer slivers.
  std::uint32_t clip(std::uint32_t i) {
    const std::uint32_t before = previous_[i], after = next_[i];
    triangles_.insert(triangles_.end(), {before, i, after});
    next_[before] = after;
    previous_[after] = before;
    next_[i] = i;
    stale_ = true;
    return after;
  }

  void fan(std::uint32_t first) {
    for (std::uint32_t b = next_[first], c = next_[b]; c != first; b = c, c = next_[c])
      triangles_.insert(triangles_.end(), {first, b, c});
  }

  std::vector<Point> points_;
  std::vector<std::uint32_t>& triangles_;
  std::vector<std::uint32_t> next_, previous_, reflex_;
  std::size_t budget_;  ///< point-in-ear tests left
  bool stale_ = false;  ///< reflex_ holds corners that are not reflex any more
};

}  // namespace

void triangulate(std::span<const Vec3> polygon, std::vector<std::uint32_t>& triangles) {
  if (polygon.size() == 3) triangles.insert(triangles.end(), {0, 1, 2});
  if (polygon.size() > 3) EarClipper(project(polygon), triangles).run();
}

}  // namespace penumbra
