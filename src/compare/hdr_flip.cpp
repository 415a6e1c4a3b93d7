#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "compare/flip.h"

namespace penumbra {
namespace {

// Narkowicz's fit of ACES' filmic curve (2016), (a x² + b x) / (c x² + d x + e), with the 0.6 of
// exposure that he asks for inside.
constexpr double kA = 0.6 * 0.6 * 2.51, kB = 0.6 * 0.03, kC = 0.6 * 0.6 * 2.43, kD = 0.6 * 0.59,
                 kE = 0.14;

float tone_mapped(float x) {
  // Beyond this the squares overflow; the curve is over 1 long before.
  if (x > 1e9f) return 1;
  if (!(x > 0)) return 0;
  const float mapped =
      (static_cast<float>(kA) * x + static_cast<float>(kB)) * x /
      ((static_cast<float>(kC) * x + static_cast<float>(kD)) * x + static_cast<float>(kE));
  return std::min(mapped, 1.0f);
}

// The light that becomes 0.85: the paper's t for both ends of the range.
double light_of_bright_tone() {
  constexpr double t = 0.85;
  const double p = (kB - t * kD) / (kA - t * kC), q = -t * kE / (kA - t * kC);
  return -p / 2 + std::sqrt(p * p / 4 - q);
}

Image exposed(const Image& image, float ev) {
  const float scale = std::exp2(ev);
  Image out = image;
  parallel_for(out.height, [&](std::size_t y) {
    float* row = out.at(0, static_cast<int>(y));
    for (int i = 0; i < out.width * out.channels; ++i) row[i] = tone_mapped(row[i] * scale);
  });
  return out;
}

std::vector<float> luminances(const Image& image) {
  std::vector<float> values;
  const int c = image.channels;
  for (std::size_t i = 0; i + c <= image.data.size(); i += c) {
    const float* p = image.data.data() + i;
    const float y = c < 3 ? p[0] : 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
    values.push_back(y > 0 ? y : 0);
  }
  return values;
}

// Of an even number of values, the mean of the middle two.
double median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (double{*middle} + double{*std::max_element(values.begin(), middle)});
}

struct Range {
  double first = 0, last = 0;
  int count = 1;
};

Range exposures_of(const Image& reference) {
  const std::vector<float> values = luminances(reference);
  const double brightest = *std::max_element(values.begin(), values.end());
  if (brightest <= 0) return {};
  const double middle = median(values);
  // Where half the picture is black there is no exposure for the median; the range then ends 16
  // stops from its beginning.
  const double least = middle > 0 ? middle : brightest * 0x1p-16;
  const double bright = light_of_bright_tone();
  const double first = std::log2(bright / brightest), last = std::log2(bright / least);
  return {first, last, std::max(2, static_cast<int>(std::ceil(last - first)))};
}

}  // namespace

HdrFlip hdr_flip(const Image& reference, const Image& test, float pixels_per_degree) {
  const Range range = exposures_of(reference);
  HdrFlip result{Image(reference.width, reference.height, 1), static_cast<float>(range.first),
                 static_cast<float>(range.last), range.count};
  for (int i = 0; i < range.count; ++i) {
    const double step = (range.last - range.first) / std::max(range.count - 1, 1);
    const auto ev = static_cast<float>(range.first + i * step);
    const Image map = flip_map(exposed(reference, ev), exposed(test, ev), pixels_per_degree);
    for (std::size_t k = 0; k < map.data.size(); ++k)
      result.map.data[k] = std::max(result.map.data[k], map.data[k]);
  }
  return result;
}

}  // namespace penumbra
