#include "bake/chart_blocks.h"

#include <algorithm>

namespace penumbra::bake {
namespace {

constexpr int diagonal_gap = 24;
constexpr std::size_t no_chart = static_cast<std::size_t>(-1);

struct Tenants {
  std::size_t first, second = no_chart;  // of charts
};

long area_with_gutters(const Block& b) {
  const auto side = [](int n) { return (n + 2 * gutter + alignment - 1) / alignment * alignment; };
  return static_cast<long>(side(b.width)) * side(b.height);
}

Block block_of(const CutChart& chart) { return {chart.shape.width, chart.shape.height}; }

Block shared_block(const Block& a, const Block& b) {
  return {std::max(a.width, b.width) + diagonal_gap, std::max(a.height, b.height) + diagonal_gap};
}

bool pays(const Block& a, const Block& b) {
  const Block both = shared_block(a, b);
  const int most = largest_page - 2 * gutter;
  return both.width <= most && both.height <= most &&
         area_with_gutters(both) < area_with_gutters(a) + area_with_gutters(b);
}

// Triangles of like size stand next to one another in the order.
std::vector<Tenants> tenants_of(std::span<const CutChart> charts) {
  std::vector<Tenants> tenants;
  std::vector<std::size_t> halves;
  for (std::size_t i = 0; i < charts.size(); ++i)
    if (charts[i].half)
      halves.push_back(i);
    else
      tenants.push_back({i});
  std::ranges::stable_sort(halves, std::greater{}, [&](std::size_t i) {
    return std::pair(charts[i].shape.width, charts[i].shape.height);
  });
  for (std::size_t k = 0; k < halves.size(); ++k) {
    const bool shared =
        k + 1 < halves.size() && pays(block_of(charts[halves[k]]), block_of(charts[halves[k + 1]]));
    tenants.push_back({halves[k], shared ? halves[k + 1] : no_chart});
    if (shared) ++k;
  }
  return tenants;
}

}  // namespace

Vec2 ChartPlace::in_page(const Vec2& texels) const {
  const auto px = static_cast<float>(x), py = static_cast<float>(y);
  return turned ? Vec2{px + 1 - texels.x, py + 1 - texels.y} : Vec2{px + texels.x, py + texels.y};
}

PlacedCharts place_charts(std::span<const CutChart> charts, bool power_of_two) {
  const std::vector<Tenants> tenants = tenants_of(charts);
  std::vector<Block> blocks;
  for (const Tenants& t : tenants) {
    const Block first = block_of(charts[t.first]);
    blocks.push_back(t.second == no_chart ? first
                                          : shared_block(first, block_of(charts[t.second])));
  }
  const Atlas atlas = pack(blocks, power_of_two);
  PlacedCharts placed;
  placed.pages = atlas.pages;
  placed.places.resize(charts.size());
  for (std::size_t i = 0; i < tenants.size(); ++i) {
    const auto [page, x, y] = atlas.places[i];
    const auto [width, height] = blocks[i];
    placed.places[tenants[i].first] = {page, x, y, false};
    if (tenants[i].second != no_chart)
      placed.places[tenants[i].second] = {page, x + width - 1, y + height - 1, true};
    const auto side = [](int n) {
      return (n + 2 * gutter + alignment - 1) / alignment * alignment;
    };
    placed.areas.push_back({page, x - gutter, y - gutter, side(width), side(height)});
  }
  return placed;
}

}  // namespace penumbra::bake
