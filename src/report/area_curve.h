// How many points of the light would do as well: the exchange rate between a method and `area`.
#pragma once

#include <optional>
#include <vector>

#include "report/measure.h"

namespace penumbra::report {

/// `area` by its number of points, in rising order.
struct AreaCurve {
  std::vector<double> points;
  std::vector<double> errors;   ///< root mean square, in the penumbra
  std::vector<double> seconds;  ///< of one picture of one sample a pixel
};

struct EqualArea {
  std::uint64_t points = 0;
  double seconds = 0;
};

/// The least number of points whose error is not above `error`: between two measured ones by
/// straight lines through the logarithms; beyond the last on the line of the last two, the slope of
/// which is taken for −1/2 at least (chance) and −1 at most. None for an error that is not
/// positive, or without a curve.
std::optional<EqualArea> equal_area(const AreaCurve& curve, double error);

/// Measures 1, 4, 16, 64, 256 and 1024 points: the errors at no more than 4096 places of the
/// reference's penumbrae, evenly spread; the seconds up to 64 points by pictures, beyond that by
/// what 48 points more took. `area_seconds`: of 64 points, if they were measured before. Empty if
/// the reference has no penumbra.
AreaCurve measure_area_curve(const Scene& scene, const World& world, const MakeDrawer& make,
                             const Reference& reference, const RenderOptions& picture,
                             std::optional<double> area_seconds);

}  // namespace penumbra::report
