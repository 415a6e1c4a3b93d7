#include "scene/json/polygon.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

namespace penumbra::json {
namespace {

constexpr std::size_t most_vertices = 1000;
constexpr double planar_tolerance = 1e-3;

struct Point {
  double x, y;
};

// Twice the area of the triangle a b c: positive if it runs counter-clockwise.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

int sign(double x) { return (x > 0) - (x < 0); }

// For p on the line through a and b: does it lie between them, ends included?
bool between(const Point& a, const Point& b, const Point& p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

bool segments_meet(const Point& a, const Point& b, const Point& c, const Point& d) {
  const int abc = sign(turn(a, b, c)), abd = sign(turn(a, b, d));
  const int cda = sign(turn(c, d, a)), cdb = sign(turn(c, d, b));
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && between(a, b, c)) || (abd == 0 && between(a, b, d)) ||
         (cda == 0 && between(c, d, a)) || (cdb == 0 && between(c, d, b));
}

// Of edges a b and b c: does the second run back over the first?
bool folds_back(const Point& a, const Point& b, const Point& c) {
  return turn(a, b, c) == 0 && (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y) <= 0;
}

// Newell's normal: its length is twice the area.
Vec3d area_normal(std::span<const Vec3d> vertices) {
  Vec3d sum;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    sum += cross(vertices[i] - vertices[0], vertices[(i + 1) % vertices.size()] - vertices[0]);
  return sum;
}

double size_of(std::span<const Vec3d> vertices) {
  Vec3d lo = vertices[0], hi = vertices[0];
  for (const Vec3d& p : vertices) lo = min(lo, p), hi = max(hi, p);
  return length(hi - lo);
}

// The vertex farthest from the plane through the centroid, if it is too far.
std::optional<std::size_t> off_plane(std::span<const Vec3d> vertices, const Vec3d& normal,
                                     double size) {
  const Vec3d centre =
      std::accumulate(vertices.begin(), vertices.end(), Vec3d{}) / double(vertices.size());
  const auto height = [&](const Vec3d& p) { return std::abs(dot(p - centre, normal)); };
  const auto farthest = std::ranges::max_element(vertices, {}, height);
  if (height(*farthest) <= planar_tolerance * size) return {};
  return farthest - vertices.begin();
}

// Drops the coordinate in which the polygon is thinnest: what is left is exact.
std::vector<Point> flatten(std::span<const Vec3d> vertices, const Vec3d& normal) {
  const Vec3d n = abs(normal);
  const int drop = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
  int first = (drop + 1) % 3, second = (drop + 2) % 3;
  if (normal[drop] < 0) std::swap(first, second);
  std::vector<Point> points;
  for (const Vec3d& p : vertices) points.push_back({p[first], p[second]});
  return points;
}

using Edges = std::array<std::size_t, 2>;

// Two edges that meet where they must not; edge i runs from vertex i to the next.
std::optional<Edges> crossing(const std::vector<Point>& p) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point &a = p[i], &b = p[(i + 1) % n];
    if (folds_back(a, b, p[(i + 2) % n])) return Edges{i, (i + 1) % n};
    for (std::size_t j = i + 2; j < n - (i == 0); ++j)
      if (segments_meet(a, b, p[j], p[(j + 1) % n])) return Edges{i, j};
  }
  return {};
}

// The ring of vertices that are not cut off yet.
class EarClipper {
 public:
  explicit EarClipper(const std::vector<Point>& points) : points_(points) {
    const auto n = static_cast<std::uint32_t>(points.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      next_.push_back((i + 1) % n);
      previous_.push_back((i + n - 1) % n);
    }
    for (std::uint32_t i = 0; i < n; ++i) ear_.push_back(is_ear(i));
  }

  // Empty if rounding leaves no ear.
  std::vector<std::uint32_t> clip() {
    std::vector<std::uint32_t> indices;
    std::uint32_t at = 0;
    for (std::size_t left = points_.size(); left > 2; --left) {
      for (std::size_t step = 0; step < left && !ear_[at]; ++step) at = next_[at];
      if (!ear_[at]) return {};
      indices.insert(indices.end(), {previous_[at], at, next_[at]});
      at = remove(at);
    }
    return indices;
  }

 private:
  // No other vertex in the triangle at i, its boundary included. Vertices that are no neighbours of
  // a removed ear stay ears or not: only a reflex or straight vertex can stand in the way.
  bool is_ear(std::uint32_t i) const {
    const std::uint32_t before = previous_[i], after = next_[i];
    const Point &a = points_[before], &b = points_[i], &c = points_[after];
    if (!(turn(a, b, c) > 0)) return false;
    for (std::uint32_t j = next_[after]; j != before; j = next_[j]) {
      const Point& p = points_[j];
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  // Gives the next vertex.
  std::uint32_t remove(std::uint32_t i) {
    const std::uint32_t before = previous_[i], after = next_[i];
    next_[before] = after;
    previous_[after] = before;
    ear_[before] = is_ear(before);
    ear_[after] = is_ear(after);
    return after;
  }

  const std::vector<Point>& points_;
  std::vector<std::uint32_t> next_, previous_;
  std::vector<bool> ear_;
};

PolygonCut faulty(std::string fault, std::string remedy) {
  PolygonCut cut;
  cut.fault = std::move(fault);
  cut.remedy = std::move(remedy);
  return cut;
}

}  // namespace

PolygonCut cut_polygon(std::span<const Vec3d> vertices) {
  if (vertices.size() < 3 || vertices.size() > most_vertices)
    return faulty(fmt::format("the polygon has {} vertices", vertices.size()),
                  fmt::format("give 3 to {}, or use a mesh file", most_vertices));
  PolygonCut cut;
  const Vec3d area = area_normal(vertices);
  const double size = size_of(vertices);
  if (!(length(area) > 1e-9 * size * size))
    return faulty("the polygon has no area", "give vertices that go around one");
  cut.normal = normalize(area);
  if (const auto vertex = off_plane(vertices, cut.normal, size))
    return faulty(fmt::format("the polygon is not planar: vertex {} lies off its plane", *vertex),
                  "move it into the plane or use several polygons");
  const std::vector<Point> points = flatten(vertices, cut.normal);
  if (const auto edges = crossing(points))
    return faulty(fmt::format("the polygon crosses or touches itself: edges {} and {} meet",
                              (*edges)[0], (*edges)[1]),
                  "order the vertices around its border");
  cut.indices = EarClipper(points).clip();
  if (cut.indices.empty())
    return faulty("the polygon nearly touches itself", "move its borders apart");
  return cut;
}

}  // namespace penumbra::json
