// Equal values found again: what joins loose triangles to a surface.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace penumbra {

struct Weld {
  std::vector<std::uint32_t> id;     ///< per item: number of its distinct value
  std::vector<std::uint32_t> first;  ///< per distinct value: the first item that has it
};

/// Numbers distinct values from 0 in order of first appearance. Expected time linear in the count,
/// which must be below 2³¹.
Weld weld_triples(std::span<const std::array<std::uint32_t, 3>> triples);

/// The same for positions. Equal means exactly equal (−0 equals 0).
Weld weld_positions(std::span<const Vec3> positions);

}  // namespace penumbra
