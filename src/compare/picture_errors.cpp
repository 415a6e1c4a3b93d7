#include "compare/picture_errors.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "compare/ssim.h"
#include "compare/sums.h"

namespace penumbra {
namespace {

// sRGB's curve in floats.
float code_from_linear(float x) {
  return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
}

Image encoded(const Image& image) {
  Image out = image;
  parallel_for(out.height, [&](std::size_t y) {
    float* row = out.at(0, static_cast<int>(y));
    for (int i = 0; i < out.width * out.channels; ++i)
      row[i] = code_from_linear(std::clamp(row[i], 0.0f, 1.0f));
  });
  return out;
}

struct Sums {
  double squares = 0, largest = 0;
  std::size_t index = 0;  // of the largest

  void add(double error, std::size_t i) {
    squares += error * error;
    if (std::abs(error) > largest) {
      largest = std::abs(error);
      index = i;
    }
  }
  void operator+=(const Sums& other) {
    squares += other.squares;
    if (other.largest > largest) {
      largest = other.largest;
      index = other.index;
    }
  }
};

Sums sums_of(const Image& reference, const Image& test) {
  return sum_blocks<Sums>(reference.data.size(), [&](std::size_t first, std::size_t last) {
    Sums sums;
    for (std::size_t i = first; i < last; ++i)
      sums.add(double{test.data[i]} - double{reference.data[i]}, i);
    return sums;
  });
}

PictureErrors compared(const Image& reference, const Image& test, double peak) {
  const Sums sums = sums_of(reference, test);
  const std::size_t pixel = sums.index / reference.channels;
  PictureErrors errors;
  errors.rmse = std::sqrt(sums.squares / static_cast<double>(reference.data.size()));
  errors.psnr_db = errors.rmse > 0 ? 20 * std::log10(peak / errors.rmse)
                                   : std::numeric_limits<double>::infinity();
  errors.largest = sums.largest;
  errors.largest_x = static_cast<int>(pixel % reference.width);
  errors.largest_y = static_cast<int>(pixel / reference.width);
  errors.ssim = mean_ssim(reference, test, peak);
  return errors;
}

}  // namespace

PictureErrors picture_errors(const Image& reference, const Image& test, PictureKind kind) {
  assert(reference.width == test.width && reference.height == test.height);
  assert(reference.channels == test.channels && !reference.data.empty());
  if (kind == PictureKind::display) return compared(encoded(reference), encoded(test), 1);
  const float peak = *std::max_element(reference.data.begin(), reference.data.end());
  return compared(reference, test, peak > 0 ? peak : 1);
}

std::optional<std::size_t> first_not_finite(const Image& image) {
  const auto found = std::find_if(image.data.begin(), image.data.end(),
                                  [](float value) { return !std::isfinite(value); });
  if (found == image.data.end()) return std::nullopt;
  return static_cast<std::size_t>(found - image.data.begin()) / image.channels;
}

}  // namespace penumbra
