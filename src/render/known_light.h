// Light that was found before the picture is drawn.
#pragma once

#include <span>

#include "render/tile_visibility.h"

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
  /// Where more is known than these two: what arrives at every points[i] with asked[i] != 0. False:
  /// it is not, and nothing was written.
  virtual bool arrivals(std::size_t light, std::span<const TilePoint> points,
                        std::span<const std::uint8_t> asked, std::span<LightArrival> out) const {
    static_cast<void>(light), static_cast<void>(points), static_cast<void>(asked);
    static_cast<void>(out);
    return false;
  }
};

}  // namespace penumbra
