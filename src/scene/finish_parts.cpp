#include <numeric>

#include "scene/finish.h"
#include "scene/mesh/weld.h"

namespace penumbra {
namespace {

/// Union–find with path halving; the smaller number becomes the root.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

std::vector<std::uint32_t> connected_parts(const Mesh& mesh) {
  const Weld weld = weld_positions(mesh.positions);
  DisjointSets sets(weld.first.size());
  const auto vertex = [&](std::size_t i) { return weld.id[mesh.indices[i]]; };
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    sets.join(vertex(i), vertex(i + 1));
    sets.join(vertex(i), vertex(i + 2));
  }
  constexpr std::uint32_t unnumbered = 0xffffffffu;
  std::vector<std::uint32_t> number(weld.first.size(), unnumbered);
  std::vector<std::uint32_t> part(mesh.triangle_count());
  std::uint32_t parts = 0;
  for (std::size_t t = 0; t < part.size(); ++t) {
    std::uint32_t& n = number[sets.find(vertex(3 * t))];
    if (n == unnumbered) n = parts++;
    part[t] = n;
  }
  return part;
}

}  // namespace penumbra
