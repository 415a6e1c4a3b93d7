// The light of a polygon on a plane, in closed form.
#pragma once

#include <span>

#include "base/vec.h"
#include "render/cone_irradiance.h"

namespace penumbra {

/// Irradiance per unit radiance, in [0, π], of a planar convex polygon of 3 to 8 vertices, given
/// relative to the receiver in either winding; it emits to both sides. Lambert's formula,
/// ½ Σ Θᵢ Γᵢ · n over the edges of the polygon cut off at the horizon (Lambert 1760, Photometria;
/// Baum, Rushmeier, Winget 1989, Improving Radiosity Solutions through the Use of Analytically
/// Determined Form-Factors, section 3).
float polygon_irradiance(std::span<const Vec3> vertices, const Vec3& normal, Horizon horizon);

}  // namespace penumbra
