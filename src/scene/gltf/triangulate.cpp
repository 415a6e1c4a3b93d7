#include "scene/gltf/triangulate.h"

#include <algorithm>

namespace penumbra::gltf {
namespace {

std::vector<std::uint32_t> compact_dense(std::vector<std::uint32_t>& indices, std::uint32_t first,
                                         std::size_t range) {
  std::vector<std::uint32_t> new_index(range, 0), used;
  for (const std::uint32_t i : indices) new_index[i - first] = 1;
  for (std::size_t k = 0; k < range; ++k)
    if (new_index[k]) {
      new_index[k] = static_cast<std::uint32_t>(used.size());
      used.push_back(first + static_cast<std::uint32_t>(k));
    }
  for (std::uint32_t& i : indices) i = new_index[i - first];
  return used;
}

std::vector<std::uint32_t> compact_scattered(std::vector<std::uint32_t>& indices) {
  std::vector<std::uint32_t> used = indices;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (std::uint32_t& i : indices)
    i = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), i) - used.begin());
  return used;
}

}  // namespace

std::vector<std::uint32_t> triangle_list(std::vector<std::uint32_t> v, int mode) {
  if (mode == 4) {
    v.resize(v.size() / 3 * 3);
    return v;
  }
  std::vector<std::uint32_t> list;
  for (std::size_t i = 0; i + 2 < v.size(); ++i) {
    const std::size_t odd = i % 2;
    if (mode == 5)
      list.insert(list.end(), {v[i], v[i + 1 + odd], v[i + 2 - odd]});
    else
      list.insert(list.end(), {v[i + 1], v[i + 2], v[0]});
  }
  return list;
}

std::vector<std::uint32_t> compact(std::vector<std::uint32_t>& indices) {
  if (indices.empty()) return {};
  const auto [lo, hi] = std::minmax_element(indices.begin(), indices.end());
  const std::uint32_t first = *lo;
  const std::size_t range = std::size_t{*hi} - first + 1;
  // Sorting costs more than a table of the range as long as that is not much larger.
  if (range > 8 * indices.size()) return compact_scattered(indices);
  return compact_dense(indices, first, range);
}

}  // namespace penumbra::gltf
