#include "bake/raster_kernels.h"

#include <hwy/detect_targets.h>
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bake/raster_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include "bake/accumulate-inl.h"
#include "bake/collect-inl.h"
#include "bake/draw-inl.h"

#if HWY_ONCE
namespace penumbra::bake {

HWY_EXPORT(collect_in);
HWY_EXPORT(draw_in);
HWY_EXPORT(accumulate_in);
HWY_EXPORT(normalise_in);
HWY_EXPORT(emit_in);

void collect(const Occluders& occluders, const Shaft& shaft, const OwnTriangles& own,
             int light_instance, TriangleList& out, std::vector<MaskedTriangle>& masked) {
  HWY_DYNAMIC_DISPATCH(collect_in)(occluders, shaft, own, light_instance, out, masked);
}
bool draw(const TriangleList& triangles, const Projection& projection, BitRaster& raster,
          std::vector<std::uint32_t>& awkward) {
  return HWY_DYNAMIC_DISPATCH(draw_in)(triangles, projection, raster, awkward);
}
void accumulate(const TexelWeights& weights, const BitRaster* occluded, TexelSums& lit,
                TexelSums* whole) {
  HWY_DYNAMIC_DISPATCH(accumulate_in)(weights, occluded, lit, whole);
}
void normalise(TexelSums& sums, const TexelSums& whole, const TexelSums* by) {
  HWY_DYNAMIC_DISPATCH(normalise_in)(sums, whole, by);
}
void emit(const TexelSums& sums, const Vec3& emission, bool add, Vec3* out, std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(emit_in)(sums, emission, add, out, stride);
}

}  // namespace penumbra::bake
#endif
