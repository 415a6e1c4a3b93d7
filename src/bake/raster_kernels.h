// The loops in which a bake spends its time, for the widest vectors that the processor has.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/bit_raster.h"
#include "bake/own_triangles.h"
#include "bake/shaft.h"
#include "bake/triangle_list.h"

namespace penumbra::bake {

/// How far outside of a triangle a texel's centre may be, in texels, that counts as inside: covers
/// the rounding of float coordinates, so that surfaces have no cracks.
inline constexpr float edge_slack = 0x1p-9f;
/// Coordinates that are larger leave too few bits for the fraction of a texel; texels.
inline constexpr float guard_band = 4096;

/// Appends the triangles that reach into a shaft, cut off at the receiver's plane; those of
/// materials with holes, whole, to `masked`. Left out: the receiver's own triangles, what lies in
/// its plane or in a flat light's, and a mesh light's own surface.
void collect(const Occluders& occluders, const Shaft& shaft, const OwnTriangles& own,
             int light_instance, TriangleList& out, std::vector<MaskedTriangle>& masked);

/// A projection in single precision, see PyramidToBox.
struct Projection {
  Vec3 origin, x, y, w;
  float x_0 = 0, y_0 = 0, w_0 = 0;
  float least_w = 0;  ///< what has less is at the height of the apex

  Projection(const PyramidToBox& m, float least)
      : origin(m.origin),
        x(m.x),
        y(m.y),
        w(m.w),
        x_0(static_cast<float>(m.x_0)),
        y_0(static_cast<float>(m.y_0)),
        w_0(static_cast<float>(m.w_0)),
        least_w(least) {}
};

/// Sets the texels whose centres the triangles' projections hold. Appends the numbers of triangles
/// that reach up to the apex' height or far out of the raster to `awkward` instead. Returns whether
/// any bit may have been set.
bool draw(const TriangleList& triangles, const Projection& projection, BitRaster& raster,
          std::vector<std::uint32_t>& awkward);

/// How much a sample gives to a texel at offset d from it (d = texel − sample), r = |d|, with the
/// affine function a = dot(normal, d) and e = scale.
enum class Falloff : std::uint8_t {
  surface,      ///< e max(0, a) / (r² (r² + k))
  two_sided,    ///< e |a| / (r² (r² + k))
  strip,        ///< e √(r² − a²) / (r² (r² + k))
  point,        ///< e / r³
  solid_angle,  ///< e max(0, a) / r³
  turned,       ///< e where a > 0
  constant      ///< e
};

struct TexelWeights {
  Falloff falloff = Falloff::constant;
  float scale = 1, k = 0;
  Vec3 first;           ///< d of texel (0, 0)
  Vec3 step_x, step_y;  ///< of d
  Vec3 normal;
};

/// Sums over samples, texel by texel: rows of `stride` floats.
struct TexelSums {
  int width = 0, height = 0;
  std::size_t stride = 0;
  std::vector<float> values;

  void resize(int w, int h) {
    width = w, height = h;
    stride = (static_cast<std::size_t>(w) + 15) / 16 * 16;
    values.assign(stride * h, 0);
  }
  float* row(int j) { return &values[stride * j]; }
  const float* row(int j) const { return &values[stride * j]; }
};

/// Adds the weights to `lit` where the raster has no bit (null: everywhere), and everywhere to
/// `whole`, which may be null.
void accumulate(const TexelWeights& weights, const BitRaster* occluded, TexelSums& lit,
                TexelSums* whole);

/// sums · by / whole, 0 where whole is 0; `by` may be null.
void normalise(TexelSums& sums, const TexelSums& whole, const TexelSums* by);

/// out[j · stride + i] = (or +=, if `add`) sums (i, j) · emission.
void emit(const TexelSums& sums, const Vec3& emission, bool add, Vec3* out, std::size_t stride);

}  // namespace penumbra::bake
