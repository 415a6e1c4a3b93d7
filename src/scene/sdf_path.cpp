#include "scene/sdf_path.h"

#include <fmt/format.h>

#include <algorithm>

namespace penumbra {

std::string sdf_path(std::span<const std::int32_t> steps) {
  constexpr std::size_t most = 8;
  std::string text = "root";
  if (steps.size() > most) {
    text += fmt::format("...({} more)", steps.size() - most);
    steps = steps.last(most);
  }
  for (const std::int32_t step : steps)
    text += step < 0 ? std::string(".child") : fmt::format(".children[{}]", step);
  return text;
}

std::string sdf_path(const SdfTree& tree, std::uint32_t node) {
  std::vector<std::int32_t> steps;
  for (std::uint32_t i = node; i-- > 0;) {  // parents come before their children
    const SdfNode& parent = tree.nodes[i];
    if (node - parent.first_child >= parent.child_count) continue;
    const bool only = signature_of(parent.op).most_children == 1;
    steps.push_back(only ? -1 : static_cast<std::int32_t>(node - parent.first_child));
    node = i;
  }
  std::ranges::reverse(steps);
  return sdf_path(steps);
}

}  // namespace penumbra
