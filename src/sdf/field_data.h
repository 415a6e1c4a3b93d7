// What a Field holds, and its kernels for each SIMD target. Internal to the room.
#pragma once

#include "sdf/field.h"
#include "sdf/march.h"
#include "sdf/regions.h"
#include "sdf/tape.h"

namespace penumbra::sdf {

struct FieldData {
  Tape tape;
  Regions regions;
  Bounds bounds;
  bool is_bounded = true;
};

/// Any count.
void distances(const FieldData& field, const float* x, const float* y, const float* z,
               std::size_t count, float* out);
/// Lane's surface index (Tape::surfaces) and 1 where materials blend; count ≤ 16.
void owners(const FieldData& field, const float* x, const float* y, const float* z,
            std::size_t count, std::uint32_t* surface, std::uint8_t* blended);

}  // namespace penumbra::sdf
