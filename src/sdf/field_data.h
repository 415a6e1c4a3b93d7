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

struct Points {
  std::vector<float> x, y, z;
  void resize(std::size_t count) { x.resize(count), y.resize(count), z.resize(count); }
  void set(std::size_t i, const Vec3& p) { x[i] = p.x, y[i] = p.y, z[i] = p.z; }
  Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// Any count.
void distances(const FieldData& field, const float* x, const float* y, const float* z,
               std::size_t count, float* out);
/// Unit normals by differences over each point's own step.
void normals(const FieldData& field, const Points& points, const float* step, std::size_t count,
             Points& out);
/// Lane's surface index (Tape::surfaces) and 1 where materials blend; count ≤ 16.
void owners(const FieldData& field, const float* x, const float* y, const float* z,
            std::size_t count, std::uint32_t* surface, std::uint8_t* blended);

}  // namespace penumbra::sdf
