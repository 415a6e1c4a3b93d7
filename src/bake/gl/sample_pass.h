// What the processor prepares and OpenGL draws.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/own_triangles.h"
#include "bake/sample_weights.h"

namespace penumbra::bake {

inline constexpr std::size_t samples_a_word = 32, words_a_pass = 8;
inline constexpr std::size_t samples_a_pass = samples_a_word * words_a_pass;
/// Of a tile that OpenGL works on.
inline constexpr int most_tile_side = 1024;

/// The uniform block Samples of project.vert.glsl holds 32 of these.
struct GlView {
  float origin[3], least_w;
  float x[4], y[4], w[4];
  float sample[3], is_near;
  std::uint32_t bit[4];
};

/// The uniform block Weights of weights.frag.glsl holds 32 of these.
struct GlWeight {
  float first[3], scale;
  float normal[3], k;
};

/// What may hide up to 32 neighbouring samples.
struct WordPass {
  std::vector<GlWeight> weights;     ///< of each sample
  std::vector<GlView> views;         ///< of those above the receiver
  std::vector<Vec3> triangles;       ///< corners, world frame, above the receiver
  std::vector<float> spheres;        ///< boxes of 12 triangles: corner, centre, radius
  std::uint32_t below = 0;           ///< bits of those below the receiver's horizon
  std::vector<std::uint32_t> words;  ///< where not empty, the bits to begin with, row by row
};

/// Up to 256 samples of one light over one tile.
struct SamplePass {
  Vec3 origin, step_x, step_y;  ///< of the tile
  int width = 0, height = 0;
  Falloff falloff = Falloff::constant;
  std::vector<WordPass> words;
};

/// Collects by shafts, as TileBaker does, what may hide `samples` of `light`. Triangles with holes
/// are drawn here.
SamplePass prepare_pass(const Occluders& occluders, const Tile& tile, const OwnTriangles& own,
                        const SampledLight& light, std::span<const LightSample> samples,
                        BakeQuantity quantity);

}  // namespace penumbra::bake
