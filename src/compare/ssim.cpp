#include "compare/ssim.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel.h"
#include "compare/separable.h"

namespace penumbra {
namespace {

Kernel window() {
  constexpr int radius = kSsimWindow / 2;
  constexpr double deviation = 1.5;
  double weights[kSsimWindow], sum = 0;
  for (int i = 0; i < kSsimWindow; ++i) {
    const double x = (i - radius) / deviation;
    sum += weights[i] = std::exp(-0.5 * x * x);
  }
  Kernel kernel;
  for (const double weight : weights) kernel.weights.push_back(static_cast<float>(weight / sum));
  return kernel;
}

float gray(const float* pixel, int channels) {
  return channels < 3 ? pixel[0] : 0.299f * pixel[0] + 0.587f * pixel[1] + 0.114f * pixel[2];
}

// In units of the range, so that the squares of large values fit into floats.
Plane gray_rows(const Image& image, int first, int last, double range) {
  const auto scale = static_cast<float>(1 / range);
  Plane plane(image.width, last - first);
  for (int y = first; y < last; ++y)
    for (int x = 0; x < image.width; ++x)
      plane.row(y - first)[x] = scale * gray(image.at(x, y), image.channels);
  return plane;
}

Plane product(const Plane& a, const Plane& b) {
  Plane out(a.width, a.height);
  for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] = a.values[i] * b.values[i];
  return out;
}

Plane local_means(const Plane& in) {
  static const Kernel kernel = window();
  return filtered_columns(filtered_rows(in, kernel, kernel.radius()), kernel, kernel.radius());
}

// Of the windows that fill the rows [first, last).
double sum_of_windows(const Image& image_a, const Image& image_b, int first, int last,
                      double range) {
  const Plane a = gray_rows(image_a, first, last, range);
  const Plane b = gray_rows(image_b, first, last, range);
  const Plane mean_a = local_means(a), mean_b = local_means(b);
  const Plane mean_aa = local_means(product(a, a)), mean_bb = local_means(product(b, b));
  const Plane mean_ab = local_means(product(a, b));
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  double sum = 0;
  for (std::size_t i = 0; i < mean_a.values.size(); ++i) {
    const double ma = mean_a.values[i], mb = mean_b.values[i];
    const double variances = mean_aa.values[i] - ma * ma + mean_bb.values[i] - mb * mb;
    const double covariance = mean_ab.values[i] - ma * mb;
    sum +=
        (2 * ma * mb + c1) * (2 * covariance + c2) / ((ma * ma + mb * mb + c1) * (variances + c2));
  }
  return sum;
}

}  // namespace

std::optional<double> mean_ssim(const Image& a, const Image& b, double range) {
  assert(a.width == b.width && a.height == b.height && a.channels == b.channels && range > 0);
  const int columns = a.width - kSsimWindow + 1, rows = a.height - kSsimWindow + 1;
  if (columns <= 0 || rows <= 0) return std::nullopt;
  constexpr int band_rows = 64;
  std::vector<double> sums((rows + band_rows - 1) / band_rows);
  parallel_for(sums.size(), [&](std::size_t band) {
    const int first = static_cast<int>(band) * band_rows;
    const int last = std::min(first + band_rows, rows) + kSsimWindow - 1;
    sums[band] = sum_of_windows(a, b, first, last, range);
  });
  double sum = 0;
  for (const double part : sums) sum += part;
  return sum / (static_cast<double>(columns) * rows);
}

}  // namespace penumbra
