#include "compare/flip_filters.h"

#include <cmath>
#include <numbers>

namespace penumbra {
namespace {

constexpr double kPi = std::numbers::pi;

// Table 1: a term of a sensitivity function, a √(π/b) exp(−π² d²/b) at a distance of d degrees.
struct Term {
  double a, b;
  double height() const { return a * std::sqrt(kPi / b); }
};
constexpr Term kAchromatic{1, 0.0047};
constexpr Term kRedGreen{1, 0.0053};
constexpr Term kBlueYellow[2] = {{34.1, 0.04}, {13.5, 0.025}};

// Three standard deviations of the widest term, for all of them.
int contrast_radius(double pixels_per_degree) {
  return static_cast<int>(
      std::ceil(3 * std::sqrt(kBlueYellow[0].b / (2 * kPi * kPi)) * pixels_per_degree));
}

std::vector<double> gaussian_of(const Term& term, double pixels_per_degree) {
  const int radius = contrast_radius(pixels_per_degree);
  std::vector<double> values;
  for (int i = -radius; i <= radius; ++i) {
    const double degrees = i / pixels_per_degree;
    values.push_back(std::exp(-kPi * kPi * degrees * degrees / term.b));
  }
  return values;
}

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

// Without the ends that are below a 64th of a float's precision.
Kernel scaled(const std::vector<double>& values, double factor) {
  const double least = values[values.size() / 2] * 0x1p-30;
  Kernel kernel;
  for (const double value : values)
    if (value > least) kernel.weights.push_back(static_cast<float>(value * factor));
  return kernel;
}

Kernel normalized(const Term& term, double pixels_per_degree) {
  const std::vector<double> values = gaussian_of(term, pixels_per_degree);
  return scaled(values, 1 / sum_of(values));
}

// Scales the positive values to a sum of 1, the negative to −1.
Kernel balanced(const std::vector<double>& values) {
  double positive = 0, negative = 0;
  for (const double value : values) (value > 0 ? positive : negative) += std::abs(value);
  Kernel kernel;
  for (const double value : values)
    kernel.weights.push_back(static_cast<float>(value / (value > 0 ? positive : negative)));
  return kernel;
}

}  // namespace

ContrastFilters contrast_filters(double pixels_per_degree) {
  ContrastFilters filters{
      normalized(kAchromatic, pixels_per_degree), normalized(kRedGreen, pixels_per_degree), {}};
  double total = 0;
  for (const Term& term : kBlueYellow) {
    const double sum = sum_of(gaussian_of(term, pixels_per_degree));
    total += term.height() * sum * sum;
  }
  for (int i = 0; i < 2; ++i)
    filters.blue_yellow[i] = scaled(gaussian_of(kBlueYellow[i], pixels_per_degree),
                                    std::sqrt(kBlueYellow[i].height() / total));
  return filters;
}

FeatureFilters feature_filters(double pixels_per_degree) {
  constexpr double feature_width_deg = 0.082;  // w: of human edge detection, peak to trough
  const double deviation = 0.5 * feature_width_deg * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  std::vector<double> gaussian, edge, point;
  for (int i = -radius; i <= radius; ++i) {
    const double x = i / deviation;
    gaussian.push_back(std::exp(-0.5 * x * x));
    edge.push_back(-x * gaussian.back());
    point.push_back((x * x - 1) * gaussian.back());
  }
  return {balanced(gaussian), balanced(edge), balanced(point)};
}

}  // namespace penumbra
