#include "image/heat_map.h"

#include <algorithm>
#include <cmath>

#include "image/srgb.h"

namespace penumbra {
namespace {

// sRGB codes at 4⁰, 4¹ … 4⁴.
constexpr int last_stop = 4;
constexpr double stops[last_stop + 1][3] = {
    {0, 0, 0}, {62, 48, 150}, {31, 158, 137}, {245, 197, 24}, {255, 255, 255}};

}  // namespace

Image heat_map(const Image& counts) {
  Image colors(counts.width, counts.height, 3);
  for (std::size_t i = 0; i < counts.data.size(); ++i) {
    const double count = counts.data[i] > 1 ? counts.data[i] : 1.0;
    const double at = std::min(std::log2(count) / 2, double{last_stop});
    const int stop = std::min(static_cast<int>(at), last_stop - 1);
    for (int c = 0; c < 3; ++c) {
      const double code = std::lerp(stops[stop][c], stops[stop + 1][c], at - stop);
      colors.data[3 * i + c] = static_cast<float>(linear_from_srgb(code / 255));
    }
  }
  return colors;
}

}  // namespace penumbra
