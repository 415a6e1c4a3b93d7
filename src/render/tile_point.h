// What the rays of a tile met: the array that the stages of shading hand on.
#pragma once

#include <cstdint>

#include "render/shading_point.h"
#include "shadow/shadows.h"

namespace penumbra {

/// A surface seen by a sample of a pixel, directly or in mirrors.
struct TilePoint {
  ShadingPoint shading;
  Receiver receiver;  ///< for visibility queries
  PrimitiveId primitive;
  Vec3 normal;                  ///< geometric, unit, towards the viewer
  Vec3 throughput;              ///< what of its radiance reaches the pixel
  float t = 0;                  ///< metres along the ray that met it
  float width = 0, spread = 0;  ///< of the pixel's beam there: metres, and metres per metre
  std::uint32_t pixel = 0;      ///< in the tile, row by row
  std::uint64_t stream = 0;     ///< decorrelates sampled methods; unique in the picture
};

}  // namespace penumbra
