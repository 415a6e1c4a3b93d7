// How far visible fractions are from a reference.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace penumbra {

/// A point is dark where the reference is at most kDark, lit where it is at least kLit, and in a
/// penumbra between them.
inline constexpr float kDark = 0.002f, kLit = 0.998f;
/// FieldErrors::far_off counts errors beyond this.
inline constexpr float kFarOff = 0.1f;

/// Errors are test − reference: positive where the test is too light. A mean over no points is 0.
struct FieldErrors {
  std::size_t points = 0;           ///< that count
  std::size_t penumbra_points = 0;  ///< of those: kDark < reference < kLit
  std::size_t far_off = 0;          ///< |error| > kFarOff
  double rmse = 0, bias = 0;        ///< root mean square error, mean error, of all points
  double penumbra_rmse = 0, penumbra_bias = 0;  ///< of the penumbra alone
  double largest = 0;                           ///< greatest |error|
  double leaked = 0;                            ///< sum of the error where the reference is dark
  double lost = 0;                              ///< −sum of the error where the reference is lit

  /// Share of the points that are far off, in [0, 1].
  double far_off_share() const {
    return points == 0 ? 0 : static_cast<double>(far_off) / static_cast<double>(points);
  }
};

/// Compares visible fractions point by point. A point counts where `surface` is not 0 (empty: all)
/// and both values are numbers (NaN marks what no light or surface has). The spans must be of one
/// length. The same result at any thread count.
FieldErrors field_errors(std::span<const float> reference, std::span<const float> test,
                         std::span<const std::uint8_t> surface = {});

}  // namespace penumbra
