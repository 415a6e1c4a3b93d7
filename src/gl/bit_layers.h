// Targets of whole numbers.
#pragma once

#include <cstdint>
#include <span>

namespace penumbra::gl {

/// Layers of one 32-bit word a texel, drawn into one at a time and read together, as a
/// usampler2DArray. Profile::core; needs the Context that it was made under.
class BitLayers {
 public:
  /// Throws WorkError if the driver cannot draw into them.
  BitLayers(int width, int height, int count);
  ~BitLayers();
  BitLayers(const BitLayers&) = delete;
  BitLayers& operator=(const BitLayers&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }
  /// Makes a layer what programs draw into.
  void use(int layer) const;
  /// Fills the lower left width × height texels of a layer.
  void clear(int layer, std::uint32_t word, int width, int height) const;
  /// Writes them, row by row.
  void write(int layer, int width, int height, std::span<const std::uint32_t> words) const;
  /// Makes them the texture of a unit, 1 or more.
  void bind(int unit) const;

 private:
  int width_, height_;
  unsigned framebuffer_ = 0, texture_ = 0;
};

}  // namespace penumbra::gl
