// A page of the atlas while it is filled.
#pragma once

#include <vector>

#include "bake/chart_blocks.h"
#include "image/image.h"

namespace penumbra::bake {

/// What a chart's texels hold.
struct ChartTexels {
  std::vector<Vec3> value;   ///< radiance or irradiance, row by row
  std::vector<float> alpha;  ///< empty: opaque
  /// 0: no part of the chart is near the texel; 1: near; 2: within it.
  std::vector<std::uint8_t> is_known;
};

/// Linear texels and what is known of them.
class Page {
 public:
  explicit Page(const AtlasPage& size);

  /// What lies within a chart goes before what is near one, and that of the first chart before
  /// that of others.
  void put(const CutChart& chart, const ChartPlace& place, const ChartTexels& texels);
  /// Spreads what is known over the rest of an area: each texel takes the mean of its neighbours
  /// that were known a step before.
  void fill(const PlacedCharts::Area& area);

  const Image& color() const { return color_; }  ///< 3 channels
  const Image& alpha() const { return alpha_; }  ///< 1 channel
  /// The colour between texels' centres, at a place in texels.
  Vec3 sample(const Vec2& texels) const;

 private:
  Image color_, alpha_;
  std::vector<std::uint8_t> known_;
};

}  // namespace penumbra::bake
