#include "scene/gltf/warnings.h"

#include <fmt/format.h>

namespace penumbra::gltf {

void Warnings::add(const std::string& text, const std::string& which) {
  const auto [it, is_new] = index_.try_emplace(text, kinds_.size());
  if (is_new) kinds_.push_back({text, which, 0});
  ++kinds_[it->second].times;
}

std::vector<std::string> Warnings::lines() const {
  std::vector<std::string> lines;
  for (const Kind& k : kinds_) {
    std::string detail = k.first;
    if (k.times > 1)
      detail = fmt::format("{} times{}{}", k.times, k.first.empty() ? "" : ", first in ", k.first);
    lines.push_back(detail.empty() ? k.text : fmt::format("{} ({})", k.text, detail));
  }
  return lines;
}

}  // namespace penumbra::gltf
