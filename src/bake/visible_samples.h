// Which samples of the lights the texels of a chart see.
#pragma once

#include "bake/baked_irradiance.h"
#include "bake/cut_charts.h"
#include "bake/sample_bits.h"
#include "bake/texel_map.h"

namespace penumbra::bake {

/// By light: its samples for a chart, and their bits.
struct ChartSight {
  std::vector<SampledLight> lights;
  std::vector<SampleBits> bits;
};

/// The texels of `places` are those of the chart's grid. All texels of a chart share their light's
/// samples, also those of curved ones: the samples are chosen for the parallelogram round it.
/// Texels that no part of the chart is near see nothing. Thread-safe.
ChartSight chart_sight(const CutChart& chart, const WorldMesh& mesh,
                       const BakedIrradiance& irradiance, std::span<const TexelPlace> places);

}  // namespace penumbra::bake
