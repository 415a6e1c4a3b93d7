// PNG files in memory.
#pragma once

#include <cstdint>
#include <string>

#include "image/image.h"

namespace penumbra {

/// The pixels of an 8-bit PNG: a linear image of 3 or 4 channels, its colour multiplied by
/// 2^exposure_ev and encoded by the exact sRGB curve; alpha is linear.
std::string encode_png(const Image& image, float exposure_ev = 0);
std::string encode_png(int width, int height, const std::uint8_t* rgba);

/// An 8-bit grey PNG of one channel, linear: values clamped to [0, 1].
std::string encode_grey_png(const Image& image);

/// A 16-bit PNG of linear values: colour / `white`, clamped to [0, 1]. Three channels.
std::string encode_linear_png(const Image& image, float white);

}  // namespace penumbra
