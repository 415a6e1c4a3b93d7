// Shadows that the fast loops leave out, exactly and one by one: triangles that reach up to the
// sample's height or far out of the raster, triangles with holes, spheres.
#pragma once

#include "bake/bit_raster.h"
#include "bake/light_sampler.h"
#include "bake/occluders.h"
#include "bake/pyramid.h"
#include "bake/tile.h"
#include "bake/triangle_list.h"

namespace penumbra::bake {

/// How one sample is seen by one tile.
struct SampleView {
  const Tile& tile;
  PyramidToBox projection;
  double least_w;    ///< what has less is at the height of the sample
  bool at_infinity;  ///< the sample is the direction `sample`
  Vec3d sample;
};

/// Cuts the triangle off at the sample's height and the raster's sides and fills what is left.
void draw_triangle(const SampleView& view, const Vec3 corner[3], BitRaster& raster);

/// Fills the texels that a triangle with holes shades where it is opaque.
void draw_masked(const SampleView& view, const MaskedTriangle& triangle, const MaskedMesh& mask,
                 float receiver_epsilon, BitRaster& raster);

/// Fills the texels from which the segment to the sample meets the surface of a sphere: the inside
/// of a conic, cut where the sphere reaches through the receiver.
void draw_sphere(const SampleView& view, const Vec3& center, float radius, BitRaster& raster);

}  // namespace penumbra::bake
