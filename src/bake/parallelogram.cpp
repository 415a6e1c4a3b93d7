#include "bake/parallelogram.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace penumbra::bake {
namespace {

struct Point {
  double x = 0, y = 0;
  friend Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
  friend Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y}; }
  friend Point operator*(const Point& a, double s) { return {a.x * s, a.y * s}; }
};

double cross(const Point& a, const Point& b) { return a.x * b.y - a.y * b.x; }
double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y; }
double length(const Point& a) { return std::sqrt(dot(a, a)); }

constexpr double least_sine = 0.1;  // of the angle between the edges of a fit that is no rectangle
constexpr double straight = 1e-5;   // of the hull's extent: corners nearer to the line are none

using Polygon = std::vector<Point>;

// Andrew's monotone chain (1979), counter-clockwise.
Polygon hull_of(Polygon points) {
  std::ranges::sort(points,
                    [](auto& a, auto& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
  Polygon hull;
  const auto sweep = [&](auto begin, auto end) {
    const std::size_t first = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= first + 2 &&
             cross(hull.back() - hull[hull.size() - 2], *p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  sweep(points.begin(), points.end());
  sweep(points.rbegin(), points.rend());
  return hull;
}

// Without the corners that lie on the line through their neighbours, as far as can be told.
Polygon simplified(Polygon hull) {
  double extent = 0;
  for (const Point& p : hull) extent = std::max(extent, length(p - hull.front()));
  for (std::size_t i = 0; i < hull.size() && hull.size() > 3;) {
    const Point &a = hull[(i + hull.size() - 1) % hull.size()], &b = hull[(i + 1) % hull.size()];
    const double height = std::abs(cross(b - a, hull[i] - a)) / std::max(length(b - a), 1e-300);
    if (height < straight * extent)
      hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(i)), i = 0;
    else
      ++i;
  }
  return hull;
}

struct Fit {
  Point base, x, y;
  bool exact = false, half = false;
  double sine() const { return cross(x, y) / (length(x) * length(y)); }
};

// At the corner nearest to a right angle.
Fit fit_triangle(const Polygon& p) {
  Fit best;
  double sine = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Fit fit{p[i], p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i], false, true};
    if (fit.sine() > sine) best = fit, sine = fit.sine();
  }
  return best;
}

bool is_parallelogram(const Polygon& p) {
  if (p.size() != 4) return false;
  const Point gap = p[0] + p[2] - p[1] - p[3];
  return length(gap) < 1e-4 * std::min(length(p[1] - p[0]), length(p[3] - p[0]));
}

// One side of the smallest rectangle lies on the hull (Freeman and Shapira 1975).
Fit smallest_rectangle(const Polygon& hull) {
  Fit best;
  double least = INFINITY;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point side = hull[(i + 1) % hull.size()] - hull[i];
    if (!(length(side) > 0)) continue;
    const Point u = side * (1 / length(side)), v{-u.y, u.x};
    Point lo{INFINITY, INFINITY}, hi{-INFINITY, -INFINITY};
    for (const Point& p : hull) {
      lo = {std::min(lo.x, dot(p, u)), std::min(lo.y, dot(p, v))};
      hi = {std::max(hi.x, dot(p, u)), std::max(hi.y, dot(p, v))};
    }
    const double area = (hi.x - lo.x) * (hi.y - lo.y);
    if (area >= least) continue;
    least = area;
    // A sliver's rectangle keeps a second side, so that every point has coordinates in it.
    best = {u * lo.x + v * lo.y, u * (hi.x - lo.x),
            v * std::max(hi.y - lo.y, 1e-6 * (hi.x - lo.x))};
  }
  return best;
}

Fit fit(const Polygon& points) {
  const Polygon hull = simplified(hull_of(points));
  Fit sheared;
  if (hull.size() == 3) sheared = fit_triangle(hull);
  if (is_parallelogram(hull))
    sheared = {hull[0], hull[1] - hull[0], hull[3] - hull[0], true, false};
  if ((sheared.exact || sheared.half) && sheared.sine() >= least_sine) return sheared;
  return smallest_rectangle(hull);
}

}  // namespace

Parallelogram fit_parallelogram(std::span<const Vec3> points, const Vec3& normal) {
  const Frame frame = frame_around(normal);
  const Vec3d origin(points.front()), u(frame.u), v(frame.v);
  Polygon flat;
  for (const Vec3& p : points) {
    const Vec3d d = Vec3d(p) - origin;
    flat.push_back({penumbra::dot(d, u), penumbra::dot(d, v)});
  }
  const Fit f = fit(flat);
  return {Vec3(origin + u * f.base.x + v * f.base.y), Vec3(u * f.x.x + v * f.x.y),
          Vec3(u * f.y.x + v * f.y.y), f.exact, f.half};
}

}  // namespace penumbra::bake
