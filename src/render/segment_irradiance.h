// The light of a thin tube on a plane, in closed form.
#pragma once

#include "base/vec.h"
#include "render/cone_irradiance.h"

namespace penumbra {

/// Irradiance per unit radiance of a tube of `radius` round the segment from a to b (relative to
/// the receiver), taken as a line whose width is the tube's: 2 r ∫ max(cos θ, 0) sin ψ / d² dl,
/// with ψ between the line and the direction to it; the ends are dark. Right for a radius well
/// below the distance; nearer to the axis than the radius it stays as at the radius, and it is
/// never above π.
float segment_irradiance(const Vec3& a, const Vec3& b, float radius, const Vec3& normal,
                         Horizon horizon);

}  // namespace penumbra
