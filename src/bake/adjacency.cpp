#include "bake/adjacency.h"

#include <algorithm>
#include <tuple>

#include "scene/mesh/weld.h"

namespace penumbra::bake {
namespace {

struct Edge {
  std::uint32_t from, to;  // the smaller vertex first
  std::uint32_t triangle;
  bool turned;  // the triangle runs from `to` to `from`
};

std::vector<Edge> sorted_edges(const WorldMesh& mesh) {
  const Weld weld = weld_positions(mesh.positions());
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangle_count());
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = weld.id[mesh.vertex(t, k)], b = weld.id[mesh.vertex(t, (k + 1) % 3)];
      edges.push_back({std::min(a, b), std::max(a, b), t, a > b});
    }
  std::ranges::sort(edges, [](const Edge& a, const Edge& b) {
    return std::tie(a.from, a.to, a.triangle) < std::tie(b.from, b.to, b.triangle);
  });
  return edges;
}

using Pair = std::pair<std::uint32_t, std::uint32_t>;

// Of a crowd of triangles about one edge each becomes the neighbour of the next.
void join(std::span<const Edge> group, std::vector<Pair>& pairs) {
  constexpr std::size_t crowd = 8;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const std::size_t end = group.size() > crowd ? std::min(i + 2, group.size()) : group.size();
    for (std::size_t j = i + 1; j < end; ++j) {
      pairs.emplace_back(group[i].triangle, group[j].triangle);
      pairs.emplace_back(group[j].triangle, group[i].triangle);
    }
  }
}

}  // namespace

Adjacency::Adjacency(const WorldMesh& mesh) {
  const std::vector<Edge> edges = sorted_edges(mesh);
  std::vector<Pair> pairs;
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && edges[end].from == edges[i].from && edges[end].to == edges[i].to)
      ++end;
    closed_ &= end - i == 2 && edges[i].turned != edges[i + 1].turned;
    join({&edges[i], end - i}, pairs);
  }
  std::ranges::sort(pairs);
  first_.assign(mesh.triangle_count() + 1, 0);
  for (const Pair& pair : pairs) ++first_[pair.first + 1], list_.push_back(pair.second);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) first_[t + 1] += first_[t];
}

double signed_volume(const WorldMesh& mesh) {
  if (mesh.triangle_count() == 0) return 0;
  const Vec3d origin(mesh.corner(0, 0));
  double sum = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3d a = Vec3d(mesh.corner(t, 0)) - origin, b = Vec3d(mesh.corner(t, 1)) - origin,
                c = Vec3d(mesh.corner(t, 2)) - origin;
    sum += dot(a, cross(b, c)) / 6;
  }
  return sum;
}

}  // namespace penumbra::bake
