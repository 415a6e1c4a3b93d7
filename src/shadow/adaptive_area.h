// The area light by as few points as its shadow needs.
//
// Points are the prefix of an Owen-scrambled Sobol sequence: its first 16 fall one into each cell
// of a 4 × 4 grid over the light, its first 64 one into each of 8 × 8, and so on, so a cell is
// refined by the three points that fall into its empty quarters. Only cells that differ from a
// neighbouring cell are. A cone first finds receivers that see the whole light: these cost no ray.
// (Whitted's adaptive subdivision, 1980, on the light; POV-Ray's adaptive area lights are of the
// same kind.)
#pragma once

#include <cstdint>
#include <vector>

#include "shadow/light_grid.h"
#include "shadow/shadows.h"

namespace penumbra {

class AdaptiveArea {
 public:
  /// What the first points found.
  enum class Verdict : std::uint8_t { lit, all_visible, all_blocked, mixed };
  struct First {
    Verdict verdict = Verdict::lit;  ///< lit: proven by the cone
    std::uint16_t visible = 0xffff;  ///< a bit per cell of the first grid, row by row
    bool unoccluded = false;         ///< only the horizon hides a part of the light: proven too
  };

  /// `error`: of the visible fraction, > 0.
  AdaptiveArea(const World& world, const LightViews& lights, float error, std::uint32_t seed);

  /// The cone and, if need be, the first 16 points.
  First first(const Receiver& receiver, std::size_t light, std::uint64_t stream,
              ShadowCounts& counts) const;

  /// More points until the estimated standard error is below the limit. `neighbour_disagrees`: what
  /// is next to the receiver sees something else, so a unanimous first answer is not believed.
  /// `points`, which may be null, (cleared first) is left with what was traced, each weighted by
  /// its cell; empty where the fraction is 0 or 1 by the first answer alone.
  Visibility finish(const Receiver& receiver, std::size_t light, std::uint64_t stream,
                    const First& first, bool neighbour_disagrees, std::vector<LightPoint>* points,
                    ShadowCounts& counts) const;

  /// Estimated standard error. Of the cells along an edge half are cut, and a cell cut in the ratio
  /// p : 1 − p, p uniform, errs with variance 1/6 of its area squared. Unanimous points leave half
  /// the share of one of them in doubt.
  static float standard_error(int edge_cells, int cells, int points);

 private:
  class Search;

  /// How a cell of the grid of the first g² points becomes four: the points that fall into the
  /// quarters without one, and which quarter (x + 2 y) has one already.
  struct Split {
    std::uint16_t point[3];
    std::uint8_t quarter[3];
    std::uint8_t kept;
  };
  /// A table's points by cell.
  struct Cells {
    std::uint16_t first[16];                 ///< of the first grid, row by row
    std::vector<std::vector<Split>> splits;  ///< by grid, coarsest first, then row by row
  };
  Cells cells_of(const SamplePattern& table) const;

  const World& world_;
  const LightViews& lights_;
  float error_;
  int finest_;  ///< grid, 64 at most: errors below about 0.001 are not reached
  LightSamples samples_;
  std::vector<Cells> cells_;  ///< by table
};

}  // namespace penumbra
