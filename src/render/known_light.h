// Light that was found before the picture is drawn.
#pragma once

#include <span>

#include "render/tile_point.h"

namespace penumbra {

/// Thread-safe.
class KnownLight {
 public:
  virtual ~KnownLight() = default;
  /// Irradiance of one light at the points, shadows and all, per unit of its emission; negative
  /// where it is not known. Two spans of one size.
  virtual void irradiances(std::size_t light, std::span<const TilePoint> points,
                           std::span<float> out) const = 0;
  /// The visible fraction in [0, 1]; negative where it is not known.
  virtual void visible_fractions(std::size_t light, std::span<const TilePoint> points,
                                 std::span<float> out) const = 0;
};

}  // namespace penumbra
