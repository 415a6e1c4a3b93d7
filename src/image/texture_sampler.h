// Filtered texture lookups in linear light.
#pragma once

#include <vector>

#include "base/vec.h"
#include "image/texture.h"

namespace penumbra {

/// Linear colour and coverage, each in [0, 1].
struct Rgba {
  Vec3 color;
  float alpha = 1;
};

/// KHR_texture_transform: offset + R · (scale · uv) with R = (cos, sin; −sin, cos), row by row: a
/// counter-clockwise turn of the coordinates as they lie on the image, whose v points down. That is
/// what the extension's text and examples say and what viewers do; the matrix in its GLSL listing
/// turns the other way (a known erratum, KhronosGroup/glTF 1563).
Vec2 transform_uv(const TextureSlot& slot, const Vec2& uv);

/// Coverage for cut-outs: the full-resolution alpha at mesh coordinates uv, in [0, 1]; bilinear, or
/// the nearest texel if the slot says so. Needs no sampler. Thread-safe.
float sample_alpha(const TextureImage& image, const TextureSlot& slot, const Vec2& uv);

/// A texture with its mip pyramid: each level is the box-filtered one before it, in linear light.
/// Levels keep 8 bits a channel in the image's own encoding, so that a sampler costs a third of its
/// image. Keeps a reference to the image. Lookups are thread-safe.
class TextureSampler {
 public:
  /// `srgb`: the colour channels are sRGB-encoded (alpha never is).
  TextureSampler(const TextureImage& image, bool srgb);

  /// The texture at mesh coordinates `uv` (transformed by the slot here), filtered over a footprint
  /// `uv_width` wide in mesh coordinates, 0 = a point. Trilinear. Any uv is allowed; non-finite
  /// ones count as 0.
  Rgba sample(const TextureSlot& slot, const Vec2& uv, float uv_width) const;

  int level_count() const { return 1 + static_cast<int>(reduced_.size()); }
  std::size_t memory_bytes() const;  ///< beyond the image's own

 private:
  float width_in_texels(const TextureSlot& slot, float uv_width) const;

  const TextureImage& base_;
  const float* decode_;
  std::vector<TextureImage> reduced_;  // levels 1, 2, …
};

}  // namespace penumbra
