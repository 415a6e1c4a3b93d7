// How a bake is done.
#pragma once

#include <cstdint>
#include <vector>

#include "sdf/convert.h"

namespace penumbra::bake {

enum class BakeDevice : std::uint8_t {
  automatic,  ///< the cheaper of the two for each chart, by an estimate
  cpu,        ///< our rasteriser, one bit a texel; rays where there is no chart
  gl,         ///< the same by OpenGL; rays where there is no chart
  rays        ///< a shadow ray for each texel and sample
};

/// Where in its cells the points of a light lie (Heckbert and Herf 1997, section 3.7).
enum class SamplePlacement : std::uint8_t {
  jittered,        ///< anywhere in a cell each
  regular,         ///< in its middle: edges parallel to the grid show as steps
  low_discrepancy  ///< the Hammersley set
};

/// How curved charts are shadowed.
enum class CurvedShadows : std::uint8_t {
  rays,  ///< a shadow ray for each texel and sample
  plane  ///< on a plane, and projected (Heckbert and Herf 1997, section 3.9 and figure 5)
};

struct BakeOptions {
  BakeDevice device = BakeDevice::automatic;
  CurvedShadows curved = CurvedShadows::rays;
  SamplePlacement placement = SamplePlacement::jittered;
  int light_samples = 0;              ///< points a light; 0: by the solid angle below
  float solid_angle = 0.001f;         ///< each point stands for less than this of a light, sr
  float samples_scale = 1;            ///< multiplies the count for all receivers, > 0
  std::vector<float> instance_scale;  ///< per instance, the same for its charts; empty: 1
  std::uint32_t seed = 0;
  sdf::ConversionOptions conversions;  ///< of distance fields into triangles
};

}  // namespace penumbra::bake
