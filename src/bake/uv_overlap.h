// Whether triangles of a texture layout lie on one another.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/vec.h"

namespace penumbra::bake {

/// A triangle laid out in texels.
struct LaidTriangle {
  Vec2 corner[3];
  std::uint32_t group = 0;
};

/// Two triangles, by number, that reach into one another by more than a sixty-fourth of a texel.
struct UvOverlap {
  std::size_t a = 0, b = 0;
};

/// The first overlap; `across`: only between triangles of different groups. None if there is none.
std::optional<UvOverlap> find_overlap(std::span<const LaidTriangle> triangles, bool across);

}  // namespace penumbra::bake
