// The light of a disk on a plane, in closed form.
#pragma once

#include "base/vec.h"
#include "render/cone_irradiance.h"

namespace penumbra {

/// A disk as seen from the receiver.
struct DiskView {
  Vec3 center;  ///< relative to the receiver
  Vec3 normal;  ///< unit, the side that emits
  float radius = 0;
};

/// Irradiance per unit radiance, in [0, π], on a receiver with unit `normal`; 0 on and behind the
/// disk's plane. Above the horizon by the two configuration factors of a plane element to a disk,
/// parallel and perpendicular to it (Howell, A Catalog of Radiation Heat Transfer Configuration
/// Factors, B-13 and B-15); across it by integrating Lambert's contour along the arc that is left.
float disk_irradiance(const DiskView& disk, const Vec3& normal, Horizon horizon);

}  // namespace penumbra
