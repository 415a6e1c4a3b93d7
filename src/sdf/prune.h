// Shorter code for a part of space. Internal to the room.
#pragma once

#include <vector>

#include "sdf/tape.h"

namespace penumbra::sdf {

/// For one word of a code and sixteen cells: what the accumulator and the value that joins it can
/// be within the cell. Only set where something joins.
struct Ranges {
  float acc_lo[16], acc_hi[16], v_lo[16], v_hi[16];
};

/// Sixteen cells: centres and radii.
struct Cells {
  float x[16], y[16], z[16], radius[16];
};

/// ranges: one entry for each word.
void ranges_in(const Tape& tape, std::span<const Word> code, const Cells& cells,
               std::vector<Ranges>& ranges);

/// The words that matter in the cell of a lane: within it they give the same values, bit for bit.
/// A branch of min, max or their smooth forms goes where its range keeps it from the result; a
/// branch of nested minima also where it stays above the whole minimum (Keeter 2020, Massively
/// Parallel Rendering of Complex Closed-Form Implicit Surfaces, section 3, has the first).
void prune(const Tape& tape, std::span<const Word> code, const std::vector<Ranges>& ranges,
           int lane, std::vector<Word>& out);

}  // namespace penumbra::sdf
