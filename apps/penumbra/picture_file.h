// Pictures read from files, for comparison.
#pragma once

#include <string>

#include "compare/picture_errors.h"
#include "image/image.h"

namespace penumbra::app {

struct PictureFile {
  std::string file;
  Image image;  ///< 1 or 3 channels, linear
  PictureKind kind = PictureKind::display;
};

/// A .png, or R, G and B of an .exr, or its `channel` (empty: the only one where there is no R, G
/// and B). Throws InputError, also for transparent pixels.
PictureFile read_picture(const std::string& file, const std::string& channel);

/// Checks that the pictures can be compared: size, kind, channels and values. Values that are no
/// numbers in the same way in both, such as the depth of what is infinitely far, become 0. Throws
/// InputError. Returns how many pixels have such values.
std::size_t make_comparable(PictureFile& reference, PictureFile& test);

}  // namespace penumbra::app
