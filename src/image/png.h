// PNG files: pictures for people, 8 bits, sRGB.
#pragma once

#include <string>

#include "image/image.h"

namespace penumbra {

/// Writes a linear image of 1, 3 or 4 channels, its colour multiplied by 2^exposure_ev and encoded
/// by the exact sRGB curve; alpha is linear. NaN and negative values become 0. Throws WorkError and
/// leaves no file if that fails.
void write_png(const std::string& path, const Image& image, float exposure_ev = 0);

/// Reads a PNG as linear RGBA of 4 channels. Throws InputError.
Image read_png(const std::string& path);

}  // namespace penumbra
