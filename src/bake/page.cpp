#include "bake/page.h"

#include <algorithm>
#include <cmath>

namespace penumbra::bake {
namespace {

struct Texel {
  int x, y;
};

}  // namespace

Page::Page(const AtlasPage& size)
    : color_(size.width, size.height, 3),
      alpha_(size.width, size.height, 1),
      known_(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height)) {
  std::ranges::fill(alpha_.data, 1.0f);
}

void Page::put(const CutChart& chart, const ChartPlace& place, const ChartTexels& texels) {
  const int width = chart.shape.width;
  for (std::size_t k = 0; k < texels.value.size(); ++k) {
    if (!texels.is_known[k]) continue;
    const int i = static_cast<int>(k) % width, j = static_cast<int>(k) / width;
    const int x = place.turned ? place.x - i : place.x + i;
    const int y = place.turned ? place.y - j : place.y + j;
    std::uint8_t& known =
        known_[static_cast<std::size_t>(y) * static_cast<std::size_t>(color_.width) +
               static_cast<std::size_t>(x)];
    if (known && texels.is_known[k] < 2) continue;
    float* rgb = color_.at(x, y);
    for (int c = 0; c < 3; ++c) rgb[c] = texels.value[k][c];
    if (!texels.alpha.empty()) *alpha_.at(x, y) = texels.alpha[k];
    known = 1;
  }
}

void Page::fill(const PlacedCharts::Area& area) {
  const auto known = [&](int x, int y) -> std::uint8_t& {
    return known_[static_cast<std::size_t>(y) * static_cast<std::size_t>(color_.width) +
                  static_cast<std::size_t>(x)];
  };
  const auto for_neighbours = [&](const Texel& t, const auto& visit) {
    for (int y = std::max(t.y - 1, area.y); y <= std::min(t.y + 1, area.y + area.height - 1); ++y)
      for (int x = std::max(t.x - 1, area.x); x <= std::min(t.x + 1, area.x + area.width - 1); ++x)
        if (x != t.x || y != t.y) visit(x, y);
  };
  std::vector<Texel> border, next;
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x) {
      bool beside = false;
      if (!known(x, y)) for_neighbours({x, y}, [&](int a, int b) { beside |= known(a, b) == 1; });
      if (beside) border.push_back({x, y});
    }
  constexpr std::uint8_t waiting = 2;
  while (!border.empty()) {
    next.clear();
    for (const Texel& t : border) {
      Vec3 sum;
      float alpha = 0, count = 0;
      for_neighbours(t, [&](int x, int y) {
        if (known(x, y) != 1) return;
        const float* rgb = color_.at(x, y);
        sum += Vec3(rgb[0], rgb[1], rgb[2]);
        alpha += *alpha_.at(x, y), count += 1;
      });
      for (int c = 0; c < 3; ++c) color_.at(t.x, t.y)[c] = sum[c] / count;
      *alpha_.at(t.x, t.y) = alpha / count;
    }
    for (const Texel& t : border) known(t.x, t.y) = 1;
    for (const Texel& t : border)
      for_neighbours(t, [&](int x, int y) {
        if (known(x, y)) return;
        known(x, y) = waiting;
        next.push_back({x, y});
      });
    border.swap(next);
  }
}

Vec3 Page::sample(const Vec2& texels) const {
  const float x = std::clamp(texels.x - 0.5f, 0.0f, static_cast<float>(color_.width - 1));
  const float y = std::clamp(texels.y - 0.5f, 0.0f, static_cast<float>(color_.height - 1));
  const int i = std::min(static_cast<int>(x), color_.width - 2);
  const int j = std::min(static_cast<int>(y), color_.height - 2);
  const float u = x - static_cast<float>(i), v = y - static_cast<float>(j);
  const auto at = [&](int a, int b) {
    const float* rgb = color_.at(a, b);
    return Vec3(rgb[0], rgb[1], rgb[2]);
  };
  return (at(i, j) * (1 - u) + at(i + 1, j) * u) * (1 - v) +
         (at(i, j + 1) * (1 - u) + at(i + 1, j + 1) * u) * v;
}

}  // namespace penumbra::bake
