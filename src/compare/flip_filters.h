// The filters of FLIP (Andersson et al. 2020, sections 4.1.1 and 4.2).
#pragma once

#include "compare/separable.h"

namespace penumbra {

/// How sharply the eye sees, by the contrast sensitivity functions of Johnson and Fairchild (2003)
/// as sums of Gaussians. A channel's filter is Σ k kᵀ over its kernels k, its weights add up to 1.
struct ContrastFilters {
  Kernel achromatic, red_green, blue_yellow[2];
};
ContrastFilters contrast_filters(double pixels_per_degree);

/// Edges are found by edge · gaussianᵀ and its transpose, points by point · gaussianᵀ and its
/// transpose. The Gaussian's weights add up to 1; the positive weights of the other two add up to
/// 1, the negative to −1.
struct FeatureFilters {
  Kernel gaussian, edge, point;
};
FeatureFilters feature_filters(double pixels_per_degree);

}  // namespace penumbra
