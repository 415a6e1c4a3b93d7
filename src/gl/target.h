// What programs draw into and read from: pixels of four floats.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra::gl {

/// A texture of four floats or bytes (0 … 1) a texel, read with texelFetch.
class Texture {
 public:
  enum class Kind : std::uint8_t { floats, bytes };
  Texture(int width, int height, Kind kind = Kind::floats);
  ~Texture();
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }
  unsigned id() const { return id_; }
  /// Writes the lower left width × height texels, row by row.
  void write(int width, int height, std::span<const float> texels);
  void write(int width, int height, std::span<const std::uint8_t> texels);
  /// Makes it the texture of a unit (a sampler's value), 1 or more: unit 0 is used while textures
  /// are made.
  void bind(int unit) const;

 private:
  int width_, height_;
  unsigned id_ = 0;
};

/// A framebuffer of `count` layers; layer i takes the program's output at location i.
class Target {
 public:
  /// Throws WorkError if the driver cannot draw into it. count: 1 to 4.
  Target(int width, int height, int count);
  ~Target();
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }
  int layer_count() const { return static_cast<int>(layers_.size()); }
  /// Makes it what programs draw into.
  void use() const;
  /// The lower left width × height texels of a layer, row by row from the bottom.
  std::vector<float> read(int layer, int width, int height) const;

 private:
  int width_, height_;
  unsigned framebuffer_ = 0;
  std::vector<unsigned> layers_;
};

}  // namespace penumbra::gl
