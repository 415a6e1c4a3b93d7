// The colour spaces and the colour difference of FLIP (Andersson et al. 2020, sections 4.1
// to 4.1.3).
#pragma once

#include <array>

namespace penumbra {

/// Linear RGB with sRGB's primaries; XYZ over that of white; or an opponent colour.
using Color3 = std::array<float, 3>;

/// YCxCz without its factors and offset, which linear filters of weight 1 leave as they are:
/// (Y, X − Y, Y − Z), each over white's.
Color3 opponent_from_rgb(const Color3& rgb);

/// L*, and a* and b* times L*/100 (the Hunt effect), of an opponent colour, which is clamped to
/// what RGB in [0, 1] holds.
Color3 hunt_lab_from_opponent(const Color3& opponent);

/// The colour difference ΔEc in [0, 1] of two colours of hunt_lab_from_opponent: HyAB to the power
/// of 0.7, its first two fifths spread over [0, 0.95].
float color_difference(const Color3& a, const Color3& b);

}  // namespace penumbra
