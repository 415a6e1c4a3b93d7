#include "shadow/adaptive_area.h"

#include <algorithm>
#include <cmath>

#include "geometry/embree_scene.h"
#include "shadow/light_guard.h"

namespace penumbra {
namespace {

constexpr int first_grid = 4;
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
  for (int g = first_grid; g <= finest_; g *= 2) ++grids_;
  for (int t = 0; t < samples_.table_count(); ++t)
    for (int g = first_grid; g <= finest_; g *= 2) {
      auto& cells = point_in_cell_.emplace_back(static_cast<std::size_t>(g * g));
      for (int i = 0; i < g * g; ++i) {
        const Vec2 p = samples_.table(t)[i];
        cells[static_cast<std::size_t>(cell_of(p.y, g) * g + cell_of(p.x, g))] =
            static_cast<std::uint16_t>(i);
      }
    }
}

/// One receiver, one light.
class AdaptiveArea::Search {
 public:
  Search(const AdaptiveArea& area, const Receiver& receiver, std::size_t light,
         std::uint64_t stream)
      : area_(area),
        receiver_(receiver),
        light_(area.lights_.light(light)),
        make_(area.lights_, light, receiver.position,
              on_plane_epsilon(area.world_, light_.position, receiver.position)),
        pattern_(area.samples_.unshifted_pattern(hash(stream, light))),
        origin_(receiver.position + receiver.normal * area.world_.epsilon_at(receiver.position)) {}

  /// Traces points `asked_` and stores what they see in `seen_`.
  void trace(ShadowCounts& counts) {
    rays_.clear(), ray_point_.clear();
    for (const int i : asked_) {
      const LightTarget& target = memory_.target[static_cast<std::size_t>(i)] =
          make_.target(pattern_, i);
      seen(i) = false;
      if (dot(target.direction, receiver_.normal) <= 0) continue;
      rays_.push_back({origin_, target.direction, 0, std::max(target.t_max, 0.0f)});
      ray_point_.push_back(i);
    }
    blocked_.resize(rays_.size());
    const int own = light_.type == LightType::mesh ? light_.instance : -1;
    area_.world_.embree().occluded(rays_, own, blocked_.data());
    counts.rays += rays_.size();
    for (std::size_t k = 0; k < rays_.size(); ++k) seen(ray_point_[k]) = !blocked_[k];
  }

  /// The first points' grid, traced.
  BitGrid first(ShadowCounts& counts) {
    asked_.clear();
    for (int i = 0; i < first_grid * first_grid; ++i) asked_.push_back(i);
    trace(counts);
    return first_from_seen();
  }

  void recall(std::uint16_t visible) {
    for (int i = 0; i < first_grid * first_grid; ++i) {
      const Vec2 p = pattern_.square[i];
      const int cell = cell_of(p.y, first_grid) * first_grid + cell_of(p.x, first_grid);
      seen(i) = visible >> cell & 1;
      memory_.target[static_cast<std::size_t>(i)] = make_.target(pattern_, i);
    }
  }

  BitGrid first_from_seen() {
    BitGrid grid;
    grid.g = first_grid;
    for (int i = 0; i < first_grid * first_grid; ++i) {
      const Vec2 p = pattern_.square[i];
      grid.set(cell_of(p.x, first_grid), cell_of(p.y, first_grid), seen(i));
    }
    return grid;
  }

  /// Traces the three new points of every cell that `split` names; the grid at twice the
  /// resolution. Cells that are not split keep their value. `own` marks cells that were sampled as
  /// such.
  BitGrid refine(const BitGrid& grid, const BitGrid& split, BitGrid& own, ShadowCounts& counts) {
    const int g = 2 * grid.g, points = g * g;
    BitGrid out = grid.doubled(), cells = split.doubled();
    asked_.clear();
    for_each(cells, [&](int x, int y) {
      const int i = point_at(x, y, g);
      if (i >= points / 4) asked_.push_back(i);
    });
    trace(counts);
    for_each(cells, [&](int x, int y) { out.set(x, y, seen(point_at(x, y, g))); });
    own = cells;
    return out;
  }

  /// Leaves the sampled points, weighted by the cells that they stand for.
  void collect(const BitGrid& sampled, std::vector<LightPoint>& points) const {
    const int g = sampled.g;
    const float share = 1 / static_cast<float>(g * g);
    for_each(sampled, [&](int x, int y) {
      const int i = point_at(x, y, g);
      const LightTarget& target = memory_.target[static_cast<std::size_t>(i)];
      points.push_back(
          {target.direction, target.weight * share, seen_[static_cast<std::size_t>(i)] != 0});
    });
  }

  template <class Body>
  static void for_each(const BitGrid& grid, const Body& body) {
    for (int y = 0; y < grid.g; ++y)
      for (std::uint64_t row = grid.rows[y]; row; row &= row - 1) body(std::countr_zero(row), y);
  }

 private:
  /// The point among the first g² that falls into cell (x, y) of a g × g grid.
  int point_at(int x, int y, int g) const {
    const int level = std::countr_zero(static_cast<unsigned>(g / first_grid));
    const auto& cells =
        area_.point_in_cell_[static_cast<std::size_t>(pattern_.table * area_.grids_ + level)];
    return cells[static_cast<std::size_t>(y * g + x)];
  }
  std::uint8_t& seen(int i) { return seen_[static_cast<std::size_t>(i)]; }

  const AdaptiveArea& area_;
  const Receiver& receiver_;
  const Light& light_;
  LightPoints make_;
  SamplePattern pattern_;
  Vec3 origin_;
  struct Scratch {
    std::vector<std::uint8_t> seen = std::vector<std::uint8_t>(64 * 64), blocked;
    std::vector<LightTarget> target = std::vector<LightTarget>(64 * 64);
    std::vector<int> asked, ray_point;
    std::vector<ShadowRay> rays;
  };
  static Scratch& scratch() {
    thread_local Scratch memory;
    return memory;
  }
  Scratch& memory_ = scratch();
  std::vector<std::uint8_t>&seen_ = memory_.seen, &blocked_ = memory_.blocked;
  std::vector<int>&asked_ = memory_.asked, &ray_point_ = memory_.ray_point;
  std::vector<ShadowRay>& rays_ = memory_.rays;
};

AdaptiveArea::First AdaptiveArea::first(const Receiver& receiver, std::size_t light,
                                        std::uint64_t stream, ShadowCounts& counts) const {
  if (whole_light_is_seen(world_, lights_, receiver, light, counts)) return {};
  const BitGrid grid = Search(*this, receiver, light, stream).first(counts);
  First first{Verdict::mixed, 0};
  for (int y = 0; y < first_grid; ++y)
    first.visible |= static_cast<std::uint16_t>(grid.rows[y] << (first_grid * y));
  if (first.visible == 0) first.verdict = Verdict::all_blocked;
  if (first.visible == 0xffff) first.verdict = Verdict::all_visible;
  return first;
}

Visibility AdaptiveArea::finish(const Receiver& receiver, std::size_t light, std::uint64_t stream,
                                const First& first, bool neighbour_disagrees,
                                std::vector<LightPoint>& points, ShadowCounts& counts) const {
  points.clear();
  if (first.verdict == Verdict::lit) return {1, 0};
  const int vouching = neighbour_disagrees ? 1 : neighbourhood;
  if (first.verdict != Verdict::mixed) {
    const float doubt = standard_error(0, 0, first_grid * first_grid * vouching);
    if (doubt <= error_) return {first.verdict == Verdict::all_visible ? 1.0f : 0.0f, doubt};
  }
  Search search(*this, receiver, light, stream);
  search.recall(first.visible);
  BitGrid grid = search.first_from_seen();
  BitGrid own;
  own.g = first_grid;
  std::fill_n(own.rows, first_grid, own.full_row());
  float error = 0;
  for (;;) {
    BitGrid split = grid.edges();
    for (int y = 0; y < grid.g; ++y) split.rows[y] &= own.rows[y];
    const int cells = grid.g * grid.g, edge_cells = split.count();
    error = standard_error(edge_cells, cells, cells * (edge_cells ? 1 : vouching));
    if (error <= error_ || grid.g >= finest_) break;
    // A cell that an edge merely nicks looks whole; while that could cost more than the error, none
    // is taken for whole.
    if (edge_cells == 0 || 0.125f / static_cast<float>(cells) > error_) split = own;
    BitGrid kept = own;
    for (int y = 0; y < grid.g; ++y) kept.rows[y] &= ~split.rows[y];
    search.collect(kept, points);
    grid = search.refine(grid, split, own, counts);
  }
  search.collect(own, points);
  return {static_cast<float>(grid.count()) / static_cast<float>(grid.g * grid.g), error};
}

}  // namespace penumbra
