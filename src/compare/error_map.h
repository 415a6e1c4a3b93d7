// Errors as colours that people with any colour vision tell apart. The scales are fixed, so that
// pictures compare.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "image/image.h"

namespace penumbra {

using Rgb8 = std::array<std::uint8_t, 3>;  ///< sRGB codes

/// Dark blue at −limit (too dark), near white at 0, dark orange at limit (too light), linear
/// between; clamped beyond. The blues of RdBu and the oranges of PuOr, 11 classes each, of Brewer's
/// ColorBrewer 2.0 (2002), interpolated in sRGB codes. NaN is kNoSurface.
Rgb8 signed_error_color(float error, float limit = 0.5f);
inline constexpr Rgb8 kNoSurface{128, 128, 128};

/// Black at 0 over purple and orange to pale yellow at 1, ever lighter; clamped. Nine points of
/// magma (Smith and van der Walt, matplotlib 1.5, 2015), interpolated in sRGB codes.
Rgb8 magnitude_color(float value);

/// Colours (3 channels, linear) of test − reference, images of one channel and one size; kNoSurface
/// where `surface` is 0 (empty: nowhere) or either is NaN.
Image signed_error_map(const Image& reference, const Image& test,
                       std::span<const std::uint8_t> surface = {}, float limit = 0.5f);

/// Colours (3 channels, linear) of an image of one channel in [0, 1], such as flip_map's.
Image magnitude_map(const Image& values);

/// The scales as bars from −limit to limit and from 0 to 1, left to right.
Image signed_error_legend(int width, int height);
Image magnitude_legend(int width, int height);

}  // namespace penumbra
