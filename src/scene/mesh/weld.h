// Equal positions found again: what joins loose triangles to a surface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace penumbra {

struct Weld {
  std::vector<std::uint32_t> id;     ///< per position: number of its distinct value
  std::vector<std::uint32_t> first;  ///< per distinct value: the first position that has it
};

/// Numbers distinct positions from 0 in order of first appearance. Equal means exactly equal
/// (−0 equals 0). Expected time linear in the count, which must be below 2³¹.
Weld weld_positions(std::span<const Vec3> positions);

}  // namespace penumbra
