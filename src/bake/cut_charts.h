// From instances to charts.
#pragma once

#include <string>
#include <vector>

#include "bake/chart.h"
#include "bake/receivers.h"

namespace penumbra::bake {

/// A chart as it is cut from an instance.
struct CutChart {
  PlanarChart shape;  ///< of a curved chart: its triangles are seen along the normal
  bool flat = true;   ///< all triangles lie in the parallelogram's plane and are shaded flat
  bool half = false;  ///< the triangle below the diagonal from edge_x to edge_y
  /// Of a curved chart: the triangles round it where the surface goes on. Texels there show these,
  /// so that the chart's light goes on beyond its border and meets that of its neighbours.
  std::vector<std::uint32_t> apron;
  float texel_size = 0;  ///< metres, before rounding to whole texels
};

struct ChartOptions {
  float texel_size = 0;  ///< metres, > 0
  /// Finer texels where a base-colour texture has more detail, down to this part of texel_size.
  float finest = 0.25f;
  int most_texels = 4080;  ///< along a side of a chart
};

/// What the charts could not do as asked, for people.
struct ChartRemarks {
  std::vector<std::string> coarse;    ///< names of objects whose charts met most_texels
  std::vector<std::string> blurred;   ///< whose base-colour texture is finer than the texels
  std::vector<std::string> squeezed;  ///< whose layout leaves some triangles no texels of their own
};

/// The side of the base-colour texture's texels on these triangles, metres; none: no texture.
std::optional<float> base_color_texel(const Scene& scene, const WorldMesh& mesh,
                                      std::span<const std::uint32_t> triangles);

/// Cuts one side of an instance into charts. Every triangle is in one of them.
///
/// Connected coplanar triangles are a chart each, and what is curved or of too many small facets is
/// cut into smooth regions (smooth_regions.h) without overlap.
std::vector<CutChart> cut_charts(const Scene& scene, const WorldMesh& mesh,
                                 const Adjacency& adjacency, bool back, const ChartOptions& options,
                                 ChartRemarks& remarks);

}  // namespace penumbra::bake
