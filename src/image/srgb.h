// The sRGB transfer function, IEC 61966-2-1: linear light to codes and back.
#pragma once

#include <cstdint>

namespace penumbra {

/// Both map [0, 1] to [0, 1] by the exact piecewise curve.
double linear_from_srgb(double code);
double srgb_from_linear(double linear);

/// Linear value of each 8-bit code / 255: by the sRGB curve, and without one.
const float* srgb_decode_table();
const float* unit_decode_table();

/// The 8-bit sRGB code nearest to a linear value, exactly as rounding the curve gives it; values
/// outside [0, 1] are clamped, NaN is 0. Thread-safe.
class SrgbEncoder {
 public:
  SrgbEncoder();
  std::uint8_t operator()(float linear) const {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    const std::uint8_t code = first_code_[static_cast<int>(linear * kBins)];
    return static_cast<std::uint8_t>(code + (linear >= lower_end_[code + 1]));
  }

 private:
  // The curve rises by at most 12.92 · 255 codes a unit: less than one code in each bin.
  static constexpr int kBins = 4096;
  std::uint8_t first_code_[kBins];
  float lower_end_[257];  // the smallest float that rounds to the code
};

const SrgbEncoder& srgb_encoder();

}  // namespace penumbra
