// "did you mean …?"
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace penumbra {

/// The candidate with the smallest edit distance to `name`; the first of equals; empty if there is
/// no candidate.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> candidates);

}  // namespace penumbra
