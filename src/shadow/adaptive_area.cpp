#include "shadow/adaptive_area.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "shadow/light_guard.h"
#include "shadow/light_rays.h"

namespace penumbra {
namespace {

constexpr int first_grid = 4;
constexpr int first_points = first_grid * first_grid;
constexpr int neighbourhood = 9;  // pixels whose first points agree vouch for one another

int cell_of(float x, int g) { return std::min(static_cast<int>(x * static_cast<float>(g)), g - 1); }

// One finer than the grid at which a long straight edge, crossing about g cells on either side, is
// known well enough: some edges are longer.
int finest_grid(float error) {
  int g = first_grid;
  while (g < 64 && AdaptiveArea::standard_error(2 * g, g * g, g * g) > error) g *= 2;
  return std::min(2 * g, 64);
}

}  // namespace

float AdaptiveArea::standard_error(int edge_cells, int cells, int points) {
  if (edge_cells == 0) return 0.5f / static_cast<float>(points + 1);
  return std::sqrt(static_cast<float>(edge_cells) / 12) / static_cast<float>(cells);
}

AdaptiveArea::AdaptiveArea(const World& world, const LightViews& lights, float error,
                           std::uint32_t seed)
    : world_(world),
      lights_(lights),
      error_(error),
      finest_(finest_grid(error)),
      samples_(finest_ * finest_, seed) {
  for (int t = 0; t < samples_.table_count(); ++t) cells_.push_back(cells_of(samples_.table(t)));
}

AdaptiveArea::Cells AdaptiveArea::cells_of(const SamplePattern& table) const {
  const auto cell = [&](int i, int g) {
    return static_cast<std::size_t>(cell_of(table.square_y[i], g) * g +
                                    cell_of(table.square_x[i], g));
  };
  Cells cells;
  for (int i = 0; i < first_points; ++i)
    cells.first[cell(i, first_grid)] = static_cast<std::uint16_t>(i);
  for (int g = first_grid; g < finest_; g *= 2) {
    auto& splits = cells.splits.emplace_back(static_cast<std::size_t>(g * g));
    std::vector<int> found(splits.size());
    for (int i = 0; i < 4 * g * g; ++i) {
      const std::size_t parent = cell(i, g), child = cell(i, 2 * g);
      const std::size_t at = child % 2 + child / static_cast<std::size_t>(2 * g) % 2 * 2;
      const auto quarter = static_cast<std::uint8_t>(at);
      Split& split = splits[parent];
      if (i < g * g) {
        split.kept = quarter;
        continue;
      }
      const auto n = static_cast<std::size_t>(found[parent]++);
      split.point[n] = static_cast<std::uint16_t>(i), split.quarter[n] = quarter;
    }
  }
  return cells;
}

/// One receiver, one light. Every point that is traced gets a slot, in the order of tracing; each
/// round starts at a packet of its own.
class AdaptiveArea::Search {
 public:
  Search(const AdaptiveArea& area, const Receiver& receiver, std::size_t light,
         std::uint64_t stream, bool unoccluded)
      : rays_(area.world_, area.lights_, receiver, light,
              area.samples_.unshifted_pattern(hash(stream, light)), unoccluded),
        cells_(area.cells_[static_cast<std::size_t>(rays_.pattern().table)]) {
    for (const std::uint16_t point : cells_.first) ask(point);
  }

  /// Traces the first points: a bit per cell of the first grid, row by row.
  std::uint16_t first(ShadowCounts& counts) {
    rays_.trace(m_.x, m_.y, first_points, nullptr, m_.visible, counts);
    return static_cast<std::uint16_t>(m_.visible[0] | m_.visible[1] << 8);
  }

  /// Starts from what the first points saw. `want_points`: list() will be called.
  BitGrid recall(std::uint16_t visible, bool want_points) {
    want_points_ = want_points;
    m_.visible[0] = static_cast<std::uint8_t>(visible);
    m_.visible[1] = static_cast<std::uint8_t>(visible >> 8);
    if (want_points) rays_.make(m_.x, m_.y, first_points, m_.targets);
    end_round(first_grid);
    BitGrid grid(first_grid);
    for (int i = 0; i < first_points; ++i) m_.slot[0][i] = static_cast<std::uint16_t>(i);
    for (int y = 0; y < first_grid; ++y) grid.rows[y] = visible >> (first_grid * y) & 15;
    return grid;
  }

  /// Traces the three new points of every cell that `split` names; the grid at twice the
  /// resolution. Cells that are not split keep their value.
  BitGrid refine(const BitGrid& grid, const BitGrid& split, ShadowCounts& counts) {
    BitGrid out = grid.doubled();
    const int g = grid.g, first = slots_;
    const auto& splits = cells_.splits[static_cast<std::size_t>(level_)];
    const std::uint16_t* slot = m_.slot[level_ % 2];
    std::uint16_t* finer = m_.slot[(level_ + 1) % 2];
    ++level_;
    for (int y = 0; y < g; ++y)
      for (std::uint64_t row = split.rows[y]; row; row &= row - 1) {
        const int x = std::countr_zero(row), cell = y * g + x;
        const Split& s = splits[static_cast<std::size_t>(cell)];
        const int corner = 4 * y * g + 2 * x;
        const auto quarter = [&](int q) { return corner + (q & 1) + (q >> 1) * 2 * g; };
        finer[quarter(s.kept)] = slot[cell];
        m_.share[slot[cell]] *= 0.25f;
        for (int i = 0; i < 3; ++i) {
          finer[quarter(s.quarter[i])] = static_cast<std::uint16_t>(slots_);
          m_.cell[slots_] = static_cast<std::uint16_t>(quarter(s.quarter[i]));
          ask(s.point[i]);
        }
      }
    const int packet = first / LightPacket::size;
    rays_.trace(m_.x + first, m_.y + first, slots_ - first,
                want_points_ ? m_.targets + packet : nullptr, m_.visible + packet, counts);
    for (int i = first; i < slots_; ++i) {
      const int x = m_.cell[i] % out.g, y = m_.cell[i] / out.g;
      out.set(x, y, seen(i));
    }
    end_round(out.g);
    return out;
  }

  /// The traced points, weighted by the cells that they stand for.
  void list(std::vector<LightPoint>& points) const {
    points.clear();
    for (int i = 0; i < slots_; ++i) {
      if (!(m_.share[i] > 0)) continue;
      const LightPacket& p = m_.targets[i / LightPacket::size];
      const int k = i % LightPacket::size;
      points.push_back({{p.x[k], p.y[k], p.z[k]}, p.weight[k] * m_.share[i], seen(i)});
    }
  }

 private:
  static constexpr int most_slots = 64 * 64 + 5 * LightPacket::size;
  struct Memory {
    float x[most_slots], y[most_slots];  ///< in the table
    float share[most_slots];             ///< of the light that the slot's cell is
    std::uint16_t cell[most_slots];      ///< where it was put in its round's grid
    std::uint16_t slot[2][64 * 64];      ///< by cell, of this round and the one before
    std::uint8_t visible[most_slots / LightPacket::size];
    LightPacket targets[most_slots / LightPacket::size];
  };
  static Memory& memory() {
    thread_local const auto memory = std::make_unique<Memory>();
    return *memory;
  }

  void ask(int point) {
    m_.x[slots_] = table_x_[point], m_.y[slots_] = table_y_[point];
    ++slots_;
  }
  bool seen(int slot) const {
    return m_.visible[slot / LightPacket::size] >> (slot % LightPacket::size) & 1;
  }

  /// New slots stand for a cell of a g × g grid each, those that fill up the packet for nothing.
  void end_round(int g) {
    std::fill(m_.share + round_, m_.share + slots_, 1 / static_cast<float>(g * g));
    round_ = (slots_ + LightPacket::size - 1) / LightPacket::size * LightPacket::size;
    std::fill(m_.share + slots_, m_.share + round_, 0.0f);
    slots_ = round_;
  }

  LightRays rays_;
  const Cells& cells_;
  const float *table_x_ = rays_.table_x(), *table_y_ = rays_.table_y();
  Memory& m_ = memory();
  int slots_ = 0, round_ = 0, level_ = 0;
  bool want_points_ = true;
};

AdaptiveArea::First AdaptiveArea::first(const Receiver& receiver, std::size_t light,
                                        std::uint64_t stream, ShadowCounts& counts) const {
  const LightGuard guard = guard_light(world_, lights_, receiver, light, counts);
  if (guard == LightGuard::seen) return {};
  const bool unoccluded = guard == LightGuard::unoccluded;
  First first{Verdict::mixed, Search(*this, receiver, light, stream, unoccluded).first(counts),
              unoccluded};
  if (first.visible == 0) first.verdict = Verdict::all_blocked;
  if (first.visible == 0xffff) first.verdict = Verdict::all_visible;
  return first;
}

Visibility AdaptiveArea::finish(const Receiver& receiver, std::size_t light, std::uint64_t stream,
                                const First& first, bool neighbour_disagrees,
                                std::vector<LightPoint>* points, ShadowCounts& counts) const {
  if (points) points->clear();
  if (first.verdict == Verdict::lit) return {1, 0};
  const int vouching = neighbour_disagrees ? 1 : neighbourhood;
  if (first.verdict != Verdict::mixed) {
    const float doubt = standard_error(0, 0, first_points * vouching);
    if (doubt <= error_) return {first.verdict == Verdict::all_visible ? 1.0f : 0.0f, doubt};
  }
  Search search(*this, receiver, light, stream, first.unoccluded);
  BitGrid grid = search.recall(first.visible, points != nullptr);
  BitGrid own = BitGrid::full(first_grid);
  float error = 0;
  for (;;) {
    BitGrid split = grid.edges();
    split &= own;
    const int cells = grid.g * grid.g, edge_cells = split.count();
    error = standard_error(edge_cells, cells, cells * (edge_cells ? 1 : vouching));
    if (error <= error_ || grid.g >= finest_) break;
    // A cell that an edge merely nicks looks whole; while that could cost more than the error, none
    // is taken for whole.
    if (edge_cells == 0 || 0.125f / static_cast<float>(cells) > error_) split = own;
    grid = search.refine(grid, split, counts);
    own = split.doubled();
  }
  if (points) search.list(*points);
  return {static_cast<float>(grid.count()) / static_cast<float>(grid.g * grid.g), error};
}

}  // namespace penumbra
