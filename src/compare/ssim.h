// Structural similarity: Wang, Bovik, Sheikh, Simoncelli, "Image Quality Assessment: From Error
// Visibility to Structural Similarity" (IEEE Transactions on Image Processing 13(4), 2004).
#pragma once

#include <optional>

#include "image/image.h"

namespace penumbra {

/// Side of the window in pixels: Gaussian weights of σ = 1.5 pixels whose sum is 1.
inline constexpr int kSsimWindow = 11;

/// Mean of
///   SSIM = (2 μa μb + C1) (2 σab + C2) / ((μa² + μb² + C1) (σa² + σb² + C2)),
/// C1 = (0.01 range)², C2 = (0.03 range)², over the windows that lie wholly in the picture, with
/// weighted means and covariances without Bessel's correction, at full size. Colour is seen as
/// gray: 0.299 R + 0.587 G + 0.114 B of the values as they are (Rec. 601, as in the authors'
/// program); a channel beyond the third is ignored. In [−1, 1]. None for pictures smaller than the
/// window. `range` is the greatest value that there can be. The same bits at any thread count.
std::optional<double> mean_ssim(const Image& a, const Image& b, double range);

}  // namespace penumbra
