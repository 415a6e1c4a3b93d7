// FLIP, the difference that a person sees who alternates between two pictures: Andersson, Nilsson,
// Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference Evaluator for Alternating
// Images" (HPG 2020), and for high dynamic range Andersson, Nilsson, Shirley, Akenine-Möller,
// "Visualizing Errors in Rendered High Dynamic Range Images" (Eurographics 2021).
#pragma once

#include "image/image.h"

namespace penumbra {

/// 0.7 m from a screen 0.7 m wide of 3840 pixels.
inline constexpr float kPixelsPerDegree = 67;

/// FLIP of each pixel, in [0, 1], one channel. Pictures of one size and of 1 (gray), 3 or 4
/// channels (alpha is ignored) of linear light with sRGB's primaries; values are clamped to [0, 1],
/// NaN is 0. `pixels_per_degree` is at least 1. Borders are replicated. The same bits at any thread
/// count. Time: O(pixels · pixels_per_degree).
Image flip_map(const Image& reference, const Image& test,
               float pixels_per_degree = kPixelsPerDegree);

struct HdrFlip {
  Image map;                        ///< as flip_map: the greatest over all exposures
  float first_ev = 0, last_ev = 0;  ///< of the exposures, which are equally spaced
  int exposures = 0;
};

/// FLIP over a range of exposures of unbounded linear pictures, tone-mapped by Narkowicz's fit of
/// ACES: from the brightest pixel of the reference to its median, at least 2. Negative values count
/// as 0. A reference that is black everywhere is seen at 0 EV.
HdrFlip hdr_flip(const Image& reference, const Image& test,
                 float pixels_per_degree = kPixelsPerDegree);

/// Mean of all values; 0 if there are none. The same bits at any thread count.
double mean_value(const Image& image);

}  // namespace penumbra
