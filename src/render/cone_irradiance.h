// The light of a sphere or a sun on a plane, in closed form.
#pragma once

#include "base/vec.h"

namespace penumbra {

/// How the part of a light below the receiver's plane counts.
enum class Horizon {
  exact,   ///< it is cut off: the true irradiance
  centre,  ///< it counts with its negative cosine, and the sum is not below 0. Equal to the exact
           ///< value for a light wholly above; falls to 0 where the centre of a sphere sets, so
           ///< that methods that look at the centre fade out there instead of breaking off
};

/// Irradiance per unit radiance, in [0, π], of a circular cone of directions: ∫ max(cos, 0) dω.
/// `cos_centre`: cosine between the receiver's normal and the axis; `sin2`: squared sine of the
/// cone's half angle, in [0, 1]. After Snyder 1996, Area Light Sources for Real-Time Graphics
/// (Microsoft Research MSR-TR-96-11), spherical light crossing the horizon.
float cone_irradiance(float cos_centre, float sin2, Horizon horizon);

/// The same for a sphere. From inside it fills the half space round its centre's direction.
/// `center` is relative to the receiver.
float sphere_irradiance(const Vec3& center, float radius, const Vec3& normal, Horizon horizon);

}  // namespace penumbra
