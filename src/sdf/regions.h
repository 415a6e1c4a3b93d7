// Space cut into cells, each with the code that matters there. Internal to the room.
#pragma once

#include <vector>

#include "base/vec.h"
#include "sdf/prune.h"

namespace penumbra::sdf {

/// A regular grid of cubes; its entries are cells[first …], x fastest.
struct RegionGrid {
  Vec3 lo;
  float size = 1, inverse = 1;  ///< of a cell
  int count[3] = {0, 0, 0};
  std::uint32_t first = 0;
};

/// Two grids, the inner one fine; a cell of them may be a brick of 4 × 4 × 4 smaller ones, and
/// these again. Outside, the whole code. Equal codes are kept once.
struct Regions {
  static constexpr std::uint32_t brick_bit = 0x80000000;
  static constexpr int brick_side = 4;

  struct Code {
    std::uint32_t begin, count;
  };
  RegionGrid inner, outer;
  std::vector<std::uint32_t> cells;  ///< index into codes, or brick_bit and index of 64 cells
  std::vector<Code> codes;           ///< 0 = the whole
  std::vector<Word> words;

  std::size_t memory_bytes() const {
    return cells.capacity() * 4 + codes.capacity() * sizeof(Code) + words.capacity() * 4;
  }
};

struct RegionLimits {
  std::size_t bytes = std::size_t{20} << 20;
  bool enabled = true;
};

/// Both boxes finite; `outer` holds `inner`.
Regions build_regions(const Tape& tape, const Bounds& inner, const Bounds& outer,
                      const RegionLimits& limits);

/// The entry of `codes` for a point, by itself.
std::uint32_t region_of(const Regions& regions, const Vec3& p);

}  // namespace penumbra::sdf
