// Charts put into blocks of the atlas: two triangles may share one.
#pragma once

#include <span>
#include <vector>

#include "bake/atlas.h"
#include "bake/cut_charts.h"

namespace penumbra::bake {

/// Where a chart's texels lie in its page.
struct ChartPlace {
  int page = 0;
  int x = 0, y = 0;     ///< of texel (0, 0)
  bool turned = false;  ///< by 180 degrees: texel (i, j) is at (x − i, y − j)

  /// Coordinates in the page, in texels, of chart coordinates in texels.
  Vec2 in_page(const Vec2& texels) const;
};

struct PlacedCharts {
  std::vector<ChartPlace> places;  ///< by chart
  std::vector<AtlasPage> pages;
  /// What of a page belongs to a block, gutters included.
  struct Area {
    int page, x, y, width, height;
  };
  std::vector<Area> areas;
};

/// Packs the charts. Charts of triangles are put two into a block, the second one turned by 180
/// degrees into the half that the first leaves free (Heckbert and Herf 1997, section 3.4), where
/// that takes less than two blocks do: the diagonal gap is 24 texels wide, the reach of three mip
/// levels on both of its sides.
PlacedCharts place_charts(std::span<const CutChart> charts, bool power_of_two);

}  // namespace penumbra::bake
