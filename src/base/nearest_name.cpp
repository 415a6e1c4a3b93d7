#include "base/nearest_name.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace penumbra {
namespace {

// Levenshtein's distance, one row at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

}  // namespace

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> candidates) {
  // A kilobyte of nonsense for a name needs no exact distance.
  name = name.substr(0, 64);
  const auto nearest = std::min_element(candidates.begin(), candidates.end(),
                                        [name](std::string_view a, std::string_view b) {
                                          return edit_distance(name, a) < edit_distance(name, b);
                                        });
  return nearest == candidates.end() ? std::string_view{} : *nearest;
}

}  // namespace penumbra
