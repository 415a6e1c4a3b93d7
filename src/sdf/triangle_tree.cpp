#include "sdf/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace penumbra::sdf {
namespace {

constexpr std::size_t leaf_size = 4;
constexpr float beta = 2;  // of Barill et al.: accuracy of the winding number
constexpr int most_depth = 64;

float squared(const Vec3& v) { return dot(v, v); }

float squared_to_box(const Vec3& lo, const Vec3& hi, const Vec3& p) {
  return squared(max(max(lo - p, p - hi), Vec3(0)));
}

// The part of `edge` nearest to the end of `to`, both from the same corner.
Vec3d along(const Vec3d& edge, const Vec3d& to) {
  const double l = dot(edge, edge);
  return l > 0 ? edge * std::clamp(dot(edge, to) / l, 0.0, 1.0) : Vec3d(0);
}

}  // namespace

// Quilez, "distance functions", udTriangle: above the triangle its plane, else its nearest edge.
// In double precision for slivers, whose normal floats do not know.
float TriangleTree::squared_distance(const Triangle& t, const Vec3& p, Vec3* point) {
  const Vec3d pa(p - t.a), pb(p - t.b), pc(p - t.c);
  const Vec3d ab = pa - pb, bc = pb - pc, ca = pc - pa;
  const Vec3d n = cross(bc, ab);
  const double nn = dot(n, n);
  Vec3d foot;  // seen from p
  if (nn > 0 && dot(cross(n, ab), pa) <= 0 && dot(cross(n, bc), pb) <= 0 &&
      dot(cross(n, ca), pc) <= 0) {
    foot = n * (-dot(n, pa) / nn);
  } else {
    const Vec3d feet[3] = {along(ab, pa) - pa, along(bc, pb) - pb, along(ca, pc) - pc};
    foot = *std::min_element(feet, feet + 3,
                             [](const Vec3d& a, const Vec3d& b) { return dot(a, a) < dot(b, b); });
  }
  if (point) *point = Vec3(Vec3d(p) + foot);
  return static_cast<float>(dot(foot, foot));
}

namespace {

/// A sum of angles in (−π, π], as the product of complex numbers and the turns that it has lost.
class AngleSum {
 public:
  void add(float x, float y) {
    const float l = std::abs(x) + std::abs(y);
    if (!(l > 0)) return;
    x /= l, y /= l;
    const float new_x = x_ * x - y_ * y, new_y = x_ * y + y_ * x;
    if (y_ >= 0 && y >= 0 && new_y < 0) ++turns_;
    if (y_ < 0 && y < 0 && new_y >= 0) --turns_;
    const float scale = 1 / (std::abs(new_x) + std::abs(new_y));
    x_ = new_x * scale, y_ = new_y * scale;
  }
  float angle() const {
    return std::atan2(y_, x_) + 2 * std::numbers::pi_v<float> * static_cast<float>(turns_);
  }

 private:
  float x_ = 1, y_ = 0;
  int turns_ = 0;
};

// Van Oosterom and Strackee 1983, equation (8): half the solid angle.
void add_solid_angle(const Vec3& a, const Vec3& b, const Vec3& c, AngleSum& sum) {
  const float la = length(a), lb = length(b), lc = length(c);
  sum.add(la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb, dot(a, cross(b, c)));
}

bool segment_meets(const Vec3& lo, const Vec3& hi, const Vec3& from, const Vec3& inverse) {
  float begin = 0, end = 1;
  for (int i = 0; i < 3; ++i) {
    const float a = (lo[i] - from[i]) * inverse[i], b = (hi[i] - from[i]) * inverse[i];
    begin = std::max(begin, std::min(a, b)), end = std::min(end, std::max(a, b));
  }
  return begin <= end * 1.00001f;
}

}  // namespace

int TriangleTree::crossing(const Triangle& t, const Vec3& from, const Vec3& to) {
  const Vec3d a(t.a - from), b(t.b - from), c(t.c - from), way(to - from);
  const Vec3d n = cross(b - a, c - a);
  const bool is_behind = dot(n, a) > 0, ends_behind = dot(n, a - way) > 0;
  if (is_behind == ends_behind) return 0;
  const bool ab = dot(way, cross(a, b)) > 0, bc = dot(way, cross(b, c)) > 0,
             ca = dot(way, cross(c, a)) > 0;
  if (ab != bc || bc != ca) return 0;
  return ends_behind ? 1 : -1;
}

struct TriangleTree::Builder {
  struct Item {
    Triangle t;
    Vec3 middle;
    std::uint32_t number;
  };
  TriangleTree& tree;
  std::vector<Item> items;

  std::uint32_t build(std::size_t begin, std::size_t end, int depth) {
    const auto number = static_cast<std::uint32_t>(tree.nodes_.size());
    tree.nodes_.push_back(node_over(begin, end));
    if (end - begin <= leaf_size) {
      tree.nodes_[number].next = static_cast<std::uint32_t>(tree.triangles_.size());
      tree.nodes_[number].count = static_cast<std::uint32_t>(end - begin);
      for (std::size_t i = begin; i < end; ++i)
        tree.triangles_.push_back(items[i].t), tree.numbers_.push_back(items[i].number);
      return number;
    }
    const std::size_t middle = split(begin, end, depth);
    build(begin, middle, depth + 1);
    const std::uint32_t second = build(middle, end, depth + 1);
    tree.nodes_[number].next = second;
    return number;
  }

  Node node_over(std::size_t begin, std::size_t end) const {
    Bounds box;
    Vec3d area, center;
    double weight = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle& t = items[i].t;
      for (const Vec3& v : {t.a, t.b, t.c}) box.grow(v);
      const Vec3d n = cross(Vec3d(t.b - t.a), Vec3d(t.c - t.a)) * 0.5;
      const double size = length(n) + 1e-30;
      area += n, center += Vec3d(items[i].middle) * size, weight += size;
    }
    Node node{box.lo, box.hi, 0, 0, Vec3(center / weight), 0, Vec3(area)};
    node.radius = length(max(abs(box.hi - node.center), abs(node.center - box.lo)));
    return node;
  }

  // By the surface area heuristic (MacDonald and Booth 1990) over 16 bins along the widest axis.
  std::size_t split(std::size_t begin, std::size_t end, int depth) {
    Bounds middles;
    for (std::size_t i = begin; i < end; ++i) middles.grow(items[i].middle);
    const Vec3 size = middles.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t half = begin + (end - begin) / 2;
    if (!(size[axis] > 0) || depth > most_depth) return half;
    const float lo = middles.lo[axis], scale = 15.999f / size[axis];
    const auto bin_of = [&](const Item& item) {
      return static_cast<int>((item.middle[axis] - lo) * scale);
    };
    const int cut = best_cut(begin, end, bin_of);
    const auto at = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto middle =
        std::partition(at(begin), at(end), [&](const Item& item) { return bin_of(item) < cut; });
    const auto found = static_cast<std::size_t>(middle - items.begin());
    return found > begin && found < end ? found : half;
  }

  template <class BinOf>
  int best_cut(std::size_t begin, std::size_t end, const BinOf& bin_of) const {
    std::array<Bounds, 16> boxes;
    std::array<float, 16> counts{}, below{};
    for (std::size_t i = begin; i < end; ++i) {
      const auto bin = static_cast<std::size_t>(bin_of(items[i]));
      for (const Vec3& v : {items[i].t.a, items[i].t.b, items[i].t.c}) boxes[bin].grow(v);
      ++counts[bin];
    }
    Bounds box;
    float n = 0;
    for (std::size_t i = 0; i + 1 < 16; ++i) {
      box.grow(boxes[i]), n += counts[i];
      below[i + 1] = n > 0 ? n * box.half_area() : 0;
    }
    box = {}, n = 0;
    float best = INFINITY;
    int cut = 8;
    for (std::size_t i = 15; i > 0; --i) {
      box.grow(boxes[i]), n += counts[i];
      const float cost = below[i] + (n > 0 ? n * box.half_area() : 0);
      if (cost < best) best = cost, cut = static_cast<int>(i);
    }
    return cut;
  }
};

TriangleTree::TriangleTree(std::span<const Vec3> positions,
                           std::span<const std::uint32_t> indices) {
  Builder builder{*this, {}};
  builder.items.reserve(indices.size() / 3);
  triangles_.reserve(indices.size() / 3);
  numbers_.reserve(indices.size() / 3);
  nodes_.reserve(indices.size() / 3);
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const Triangle t{positions[indices[i]], positions[indices[i + 1]], positions[indices[i + 2]]};
    builder.items.push_back({t, (t.a + t.b + t.c) / 3.0f, static_cast<std::uint32_t>(i / 3)});
  }
  if (!builder.items.empty()) builder.build(0, builder.items.size(), 0);
  nodes_.shrink_to_fit();
}

// The triangle with the least squared distance below `best`, which becomes that; else none.
std::size_t TriangleTree::visit_nearest(const Vec3& p, float& best) const {
  std::size_t found = triangles_.size();
  struct Entry {
    std::uint32_t node;
    float squared;
  };
  Entry stack[2 * most_depth + 64];
  int size = 0;
  if (!nodes_.empty()) stack[size++] = {0, squared_to_box(nodes_[0].lo, nodes_[0].hi, p)};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (!(entry.squared < best)) continue;
    const Node& node = nodes_[entry.node];
    if (node.count > 0) {
      for (std::uint32_t i = node.next; i < node.next + node.count; ++i)
        if (const float d = squared_distance(triangles_[i], p, nullptr); d < best)
          best = d, found = i;
      continue;
    }
    const std::uint32_t a = entry.node + 1, b = node.next;
    const Entry first{a, squared_to_box(nodes_[a].lo, nodes_[a].hi, p)};
    const Entry second{b, squared_to_box(nodes_[b].lo, nodes_[b].hi, p)};
    const bool swap = second.squared < first.squared;
    stack[size++] = swap ? first : second;
    stack[size++] = swap ? second : first;
  }
  return found;
}

float TriangleTree::distance(const Vec3& p, float most, std::size_t& hint) const {
  float best = most * most;
  bool is_found = false;
  if (hint < triangles_.size())
    if (const float d = squared_distance(triangles_[hint], p, nullptr); d < best)
      best = d, is_found = true;
  if (const std::size_t found = visit_nearest(p, best); found < triangles_.size())
    hint = found, is_found = true;
  return is_found ? std::sqrt(best) : most;
}

float TriangleTree::distance(const Vec3& p, float most) const {
  std::size_t hint = no_triangle;
  return distance(p, most, hint);
}

TriangleTree::Nearest TriangleTree::nearest(const Vec3& p) const {
  float best = std::numeric_limits<float>::infinity();
  const Triangle& t = triangles_[visit_nearest(p, best)];
  Nearest result{std::sqrt(best), {}, cross(t.b - t.a, t.c - t.a)};
  squared_distance(t, p, &result.point);
  return result;
}

float TriangleTree::winding(const Vec3& p) const {
  std::uint32_t stack[2 * most_depth + 64];
  int size = 0;
  float sum = 0;
  AngleSum halves;
  if (!nodes_.empty()) stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t number = stack[--size];
    const Node& node = nodes_[number];
    const Vec3 to = node.center - p;
    const float distance2 = squared(to), reach = beta * node.radius;
    if (distance2 > reach * reach) {
      sum += dot(to, node.area) / (distance2 * std::sqrt(distance2));
    } else if (node.count > 0) {
      for (std::uint32_t i = node.next; i < node.next + node.count; ++i)
        add_solid_angle(triangles_[i].a - p, triangles_[i].b - p, triangles_[i].c - p, halves);
    } else {
      stack[size++] = node.next;
      stack[size++] = number + 1;
    }
  }
  return (sum + 2 * halves.angle()) / (4 * std::numbers::pi_v<float>);
}

int TriangleTree::crossings(const Vec3& from, const Vec3& to) const {
  const Vec3 way = to - from;
  const auto inverted = [](float x) { return std::abs(x) > 1e-30f ? 1 / x : 1e30f; };
  const Vec3 inverse{inverted(way.x), inverted(way.y), inverted(way.z)};
  std::uint32_t stack[2 * most_depth + 64];
  int size = 0, sum = 0;
  if (!nodes_.empty()) stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t number = stack[--size];
    const Node& node = nodes_[number];
    if (!segment_meets(node.lo, node.hi, from, inverse)) continue;
    if (node.count == 0) {
      stack[size++] = node.next;
      stack[size++] = number + 1;
    }
    for (std::uint32_t i = node.next; i < node.next + node.count; ++i)
      sum += crossing(triangles_[i], from, to);
  }
  return sum;
}

void TriangleTree::write_texels(std::vector<float>& boxes, std::vector<float>& triangles) const {
  std::vector<std::uint32_t> skip(nodes_.size(), static_cast<std::uint32_t>(nodes_.size()));
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (node.count == 0) skip[i + 1] = node.next, skip[node.next] = skip[i];
    const float first = node.count > 0 ? static_cast<float>(node.next) : -1.0f;
    boxes.insert(boxes.end(), {node.lo.x, node.lo.y, node.lo.z, static_cast<float>(skip[i]),
                               node.hi.x, node.hi.y, node.hi.z, first});
  }
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const auto& [a, b, c] = triangles_[i];
    const auto number = static_cast<float>(numbers_[i]);
    triangles.insert(triangles.end(),
                     {a.x, a.y, a.z, 0.0f, b.x, b.y, b.z, number, c.x, c.y, c.z, 0.0f});
  }
  for (const Node& node : nodes_)
    if (node.count > 0) triangles[12 * (std::size_t{node.next} + node.count - 1) + 3] = 1;
}

std::size_t TriangleTree::memory_bytes() const {
  return nodes_.capacity() * sizeof(Node) + triangles_.capacity() * sizeof(Triangle) +
         numbers_.capacity() * sizeof(std::uint32_t);
}

bool is_closed(std::span<const Vec3> positions, std::span<const std::uint32_t> indices) {
  std::vector<std::uint32_t> order(positions.size()), place(positions.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto key = [&](std::uint32_t i) {
    const Vec3& p = positions[i];
    return std::array{p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};
  };
  std::ranges::sort(order, {}, key);
  for (std::size_t i = 0; i < order.size(); ++i)
    place[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? place[order[i - 1]] : order[i];
  struct Edge {
    std::uint32_t from, to;
    int passes;
    auto operator<=>(const Edge&) const = default;
  };
  std::vector<Edge> edges;
  edges.reserve(indices.size());
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = place[indices[i + k]], b = place[indices[i + (k + 1) % 3]];
      if (a != b) edges.push_back(a < b ? Edge{a, b, 1} : Edge{b, a, -1});
    }
  std::ranges::sort(edges);
  for (std::size_t i = 0; i < edges.size();) {
    int sum = 0;
    const Edge& first = edges[i];
    for (; i < edges.size() && edges[i].from == first.from && edges[i].to == first.to; ++i)
      sum += edges[i].passes;
    if (sum != 0) return false;
  }
  return true;
}

}  // namespace penumbra::sdf
