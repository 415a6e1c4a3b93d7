// One bit for each texel of a chart and sample of a light: whether they see each other (Heckbert
// and Herf 1997, section 4).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/bit_raster.h"

namespace penumbra::bake {

/// Texel after texel, row by row; a texel's samples in the light's order; of each byte the least
/// significant bit first. 1: visible.
class SampleBits {
 public:
  SampleBits() = default;
  SampleBits(std::size_t texels, std::size_t samples)
      : samples_(samples), bytes_((texels * samples + 7) / 8) {}

  std::size_t samples() const { return samples_; }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }
  bool at(std::size_t texel, std::size_t sample) const {
    const std::size_t bit = texel * samples_ + sample;
    return bytes_[bit / 8] >> (bit % 8) & 1;
  }
  void set(std::size_t texel, std::size_t sample, bool visible) {
    const std::size_t bit = texel * samples_ + sample;
    const auto mask = static_cast<std::uint8_t>(1u << (bit % 8));
    bytes_[bit / 8] =
        visible ? bytes_[bit / 8] | mask : bytes_[bit / 8] & static_cast<std::uint8_t>(~mask);
  }
  /// Sets a sample's bits in one row of texels, from `first` on, where `hidden` (null: nowhere) has
  /// none; they must be 0 before. width: texels.
  void set_row(std::size_t first, int width, std::size_t sample, const std::uint64_t* hidden);
  /// Takes over `count` texels of another set of as many samples, whose bits here are 0 before.
  void copy(std::size_t to, const SampleBits& from, std::size_t first, std::size_t count);

 private:
  std::size_t samples_ = 0;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace penumbra::bake
