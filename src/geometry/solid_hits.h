// What rays met of distance fields, side by side.
#pragma once

#include <cstdint>
#include <vector>

#include "sdf/field.h"

namespace penumbra {

/// Vectors of one size: one entry for each ray that met something.
struct SolidHits {
  std::vector<std::uint32_t> ray;  ///< which, rising
  std::vector<Vec3> position;
  std::vector<Vec3> normal;  ///< of the field: unit, to where it grows
  std::vector<sdf::Field::Owner> owner;
};

}  // namespace penumbra
