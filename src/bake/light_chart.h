// The texels of a chart, lit.
#pragma once

#include <optional>

#include "bake/page.h"
#include "bake/surface_light.h"

namespace penumbra::bake {

/// What texels hold.
enum class Quantity : std::uint8_t { radiance, irradiance };

struct LightOptions {
  Quantity quantity = Quantity::radiance;
  int supersample = 1;  ///< points along each side of a texel, averaged over those on the surface
  /// Charts whose texels differ from their vertices' colours, interpolated, by at most this many of
  /// the 255 steps of sRGB at `exposure_ev` may go without a texture; none: all have one.
  std::optional<float> vertex_error;
  float exposure_ev = 0;
};

/// A vertex of a chart: its place in the mesh's arrays, and its colour.
struct VertexColor {
  std::uint32_t vertex;
  Vec3 color;
};

struct LitChart {
  ChartTexels texels;  ///< empty where the vertices' colours do
  std::vector<VertexColor> vertices;
  bool has_texels() const { return !texels.value.empty(); }
};

/// Points within the texels, n × n each, row by row of the whole chart.
struct ChartSamples {
  PlanarChart grid;
  std::vector<TexelPlace> places;
  std::vector<Vec3> values;  ///< irradiance, then what texels hold
  std::vector<float> alphas;
};

/// The steps of light_chart(). find_irradiance() takes flat charts by their registered projection,
/// but for the points outside.
ChartSamples samples_of(const CutChart& chart, const WorldMesh& mesh, int supersample);
void find_irradiance(const CutChart& chart, const WorldMesh& mesh, const Irradiance& irradiance,
                     ChartSamples& samples);
LitChart compose_chart(const CutChart& chart, const WorldMesh& mesh, ChartSamples& samples,
                       const SurfaceLight& surface, const LightOptions& options);

/// Lights one chart. Texels whose centre is outside the chart's triangles take the light of the
/// nearest point inside, those farther than 1.5 texels none. Thread-safe.
LitChart light_chart(const CutChart& chart, const WorldMesh& mesh, const Irradiance& irradiance,
                     const SurfaceLight& surface, const LightOptions& options);

}  // namespace penumbra::bake
