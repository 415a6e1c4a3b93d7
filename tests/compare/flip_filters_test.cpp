#include "compare/flip_filters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace penumbra::test {
namespace {

const double pi = std::acos(-1.0);

double at(const Kernel& kernel, int x, int y) {
  const int r = kernel.radius();
  if (std::abs(x) > r || std::abs(y) > r) return 0;
  return double{kernel.weights[x + r]} * double{kernel.weights[y + r]};
}

// Table 1 of the paper, as one two-dimensional kernel.
double weight(double a1, double b1, double a2, double b2, double ppd, int x, int y) {
  const auto s = [&](int i, int j) {
    const double d2 = (i * i + j * j) / (ppd * ppd);
    return a1 * std::sqrt(pi / b1) * std::exp(-pi * pi * d2 / b1) +
           a2 * std::sqrt(pi / b2) * std::exp(-pi * pi * d2 / b2);
  };
  const int r = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
  double sum = 0;
  for (int j = -r; j <= r; ++j)
    for (int i = -r; i <= r; ++i) sum += s(i, j);
  return s(x, y) / sum;
}

TEST(ContrastFilters, AreThePapersKernels) {
  const double ppd = 67;
  const ContrastFilters f = contrast_filters(ppd);
  for (int y = -10; y <= 10; ++y)
    for (int x = -10; x <= 10; ++x) {
      EXPECT_NEAR(at(f.achromatic, x, y), weight(1, 0.0047, 0, 1, ppd, x, y), 1e-7);
      EXPECT_NEAR(at(f.red_green, x, y), weight(1, 0.0053, 0, 1, ppd, x, y), 1e-7);
      EXPECT_NEAR(at(f.blue_yellow[0], x, y) + at(f.blue_yellow[1], x, y),
                  weight(34.1, 0.04, 13.5, 0.025, ppd, x, y), 1e-8);
    }
}

TEST(FeatureFilters, AreBalanced) {
  for (const double ppd : {1.0, 67.0, 1000.0}) {
    const FeatureFilters f = feature_filters(ppd);
    const auto sum = [](const Kernel& kernel) {
      return std::accumulate(kernel.weights.begin(), kernel.weights.end(), 0.0);
    };
    EXPECT_NEAR(sum(f.gaussian), 1, 1e-6);
    EXPECT_NEAR(sum(f.edge), 0, 1e-6);
    EXPECT_NEAR(sum(f.point), 0, 1e-6);
  }
}

}  // namespace
}  // namespace penumbra::test
