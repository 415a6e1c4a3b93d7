// What separates two pictures, in numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "image/image.h"

namespace penumbra {

/// What the values of a picture mean.
enum class PictureKind : std::uint8_t {
  display,  ///< light in [0, 1] on its way to a screen; compared as sRGB codes / 255, peak 1
  linear,   ///< unbounded light; compared as it is, its peak is the reference's greatest value
};

/// Errors are test − reference over all pixels and channels, in the unit that PictureKind says.
struct PictureErrors {
  double rmse = 0;
  double psnr_db = 0;                ///< 20 log10(peak / rmse); infinite for equal pictures
  double largest = 0;                ///< greatest |error| of any channel
  int largest_x = 0, largest_y = 0;  ///< the first pixel that has it; from the top left
  std::optional<double> ssim;        ///< mean_ssim with the peak for range; none for tiny pictures
};

/// Two pictures of one size and of 1 or 3 channels, whose values are linear and finite. Codes of
/// `display` are those of the exact curve, unrounded. A reference without light has the peak 1. The
/// same bits at any thread count.
PictureErrors picture_errors(const Image& reference, const Image& test, PictureKind kind);

/// Index y · width + x of the first pixel that has a value that is no finite number.
std::optional<std::size_t> first_not_finite(const Image& image);

}  // namespace penumbra
