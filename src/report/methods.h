// What each shadow method is, in words for people.
#pragma once

#include <span>
#include <string_view>

#include "shadow/shadows.h"

namespace penumbra::report {

struct MethodText {
  ShadowKind kind;
  std::string_view name;     ///< as of --shadows
  std::string_view title;    ///< its authors, or what it does
  std::string_view summary;  ///< two sentences
  std::string_view link;     ///< where it was published
};

/// All but none, in the order of ShadowKind.
std::span<const MethodText> methods();
const MethodText& method_of(ShadowKind kind);

}  // namespace penumbra::report
