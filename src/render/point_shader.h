// Direct light on an array of points, in stages: unshadowed light, visibility, sum.
#pragma once

#include <span>
#include <vector>

#include "render/direct_light.h"
#include "render/known_light.h"
#include "render/tile_visibility.h"

namespace penumbra {

/// Methods that look at the light's centre treat the horizon by its centre too.
Horizon horizon_of(const Shadows& shadows);

/// Told of each light's arrivals at the points, in order of lights.
class ArrivalObserver {
 public:
  virtual ~ArrivalObserver() = default;
  virtual void arrived(std::size_t light, std::span<const TilePoint> points,
                       std::span<const LightArrival> arrivals) = 0;
};

/// Shades points with all lights of the scene and the ambient light. Holds the memory of its
/// stages: one for a thread.
class PointShader {
 public:
  /// Writes to radiance[i] what points[i] reflects of lights and ambient light, without emission
  /// and mirrors. Points that a light cannot brighten are not asked for their visibility unless an
  /// observer wants to know it.
  /// `known`: takes the place of `shadows`; null: nothing is known.
  void shade(const DirectLight& lights, const Shadows& shadows, const KnownLight* known,
             const Vec3& ambient, std::span<const TilePoint> points, int tile_width,
             std::vector<Vec3>& radiance, ArrivalObserver* observer, ShadowCounts& counts);

 private:
  struct Unshadowed {
    float irradiance = 0;
    Glossy glossy;
  };

  void find_unshadowed(const DirectLight& lights, std::size_t light, Horizon horizon, bool ask_all,
                       std::span<const TilePoint> points);
  void look_up(const KnownLight& known, std::size_t light, std::span<const TilePoint> points);
  void add(const Vec3& emission, std::span<const TilePoint> points, std::vector<Vec3>& radiance);

  std::vector<Unshadowed> unshadowed_;
  std::vector<std::uint8_t> asked_;
  std::vector<LightArrival> arrivals_;
  std::vector<float> irradiances_, fractions_;  ///< known ones
  std::vector<LightPoint> light_points_;
};

}  // namespace penumbra
