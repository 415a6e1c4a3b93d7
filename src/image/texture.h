// Textures as scene files give them: 8 bits a channel, with wrap modes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/vec.h"

namespace penumbra {

enum class Wrap : std::uint8_t { repeat, clamp, mirror };

/// An image as decoded: RGBA, 8 bits each, rows from the top left.
struct TextureImage {
  std::string name;
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  ///< width · height · 4
};

/// Decodes PNG, JPEG, TGA, BMP from memory. Returns false if the bytes are none of these or are
/// larger than 16384 pixels on a side; `out` is then one white pixel.
bool decode_texture(const std::uint8_t* bytes, std::size_t size, TextureImage& out);

/// One use of a texture by a material (KHR_texture_transform included).
struct TextureSlot {
  int image = -1;  ///< index into Scene::textures; -1 = no texture
  int uv_set = 0;  ///< 0 or 1: TEXCOORD_0 or TEXCOORD_1
  Wrap wrap_s = Wrap::repeat, wrap_t = Wrap::repeat;
  bool nearest = false;  ///< magnification without interpolation
  Vec2 offset{0, 0}, scale{1, 1};
  float rotation = 0;  ///< radians, counter-clockwise

  bool used() const { return image >= 0; }
};

}  // namespace penumbra
