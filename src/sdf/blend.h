// Which materials make a surface, and how much of each. Internal to the room.
#pragma once

#include "sdf/field.h"

namespace penumbra::sdf {

/// Where smooth operators join two values they mix what made them: with h = max(1 − |a − b| / k, 0)
/// the farther one counts h² / 2 (Quilez, "smooth minimum", the mix factor of the quadratic).
SurfaceAt blend_at(const FieldData& field, const Vec3& p);

}  // namespace penumbra::sdf
