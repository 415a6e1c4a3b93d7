// Textures of materials as bytes for image_lookup.glsl.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "image/texture.h"

namespace penumbra {

inline constexpr int image_texel_row = 4096;

/// Images with their mip pyramids, one behind the other; RGBA.
class ImageBytes {
 public:
  /// The image's value at `uv`, a GLSL vec2, linear, as TextureSampler has it; written once for all
  /// its uses. `width`: GLSL, of the footprint in mesh coordinates.
  std::string lookup(const std::vector<TextureImage>& images, const TextureSlot& slot, bool srgb,
                     const std::string& uv, const std::string& width);
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::size_t add(const TextureImage& image, bool srgb);

  std::vector<std::uint8_t> bytes_;
  std::map<std::pair<int, bool>, std::size_t> first_;  ///< texels, by image and srgb
};

}  // namespace penumbra
