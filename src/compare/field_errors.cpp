#include "compare/field_errors.h"

#include <cassert>
#include <cmath>

#include "compare/sums.h"

namespace penumbra {
namespace {

struct ErrorSum {
  std::size_t count = 0;
  double sum = 0, squares = 0;

  void add(double error) {
    ++count;
    sum += error;
    squares += error * error;
  }
  void operator+=(const ErrorSum& other) {
    count += other.count;
    sum += other.sum;
    squares += other.squares;
  }
  double mean() const { return count == 0 ? 0 : sum / static_cast<double>(count); }
  double root_mean_square() const {
    return count == 0 ? 0 : std::sqrt(squares / static_cast<double>(count));
  }
};

struct Sums {
  ErrorSum dark, penumbra, lit;
  std::size_t far_off = 0;
  double largest = 0;

  void add(float reference, float test) {
    const double error = double{test} - double{reference};
    (reference <= kDark ? dark : reference >= kLit ? lit : penumbra).add(error);
    far_off += std::abs(test - reference) > kFarOff ? 1 : 0;
    largest = std::max(largest, std::abs(error));
  }
  void operator+=(const Sums& other) {
    dark += other.dark;
    penumbra += other.penumbra;
    lit += other.lit;
    far_off += other.far_off;
    largest = std::max(largest, other.largest);
  }
};

FieldErrors errors_of(const Sums& sums) {
  ErrorSum all = sums.dark;
  all += sums.penumbra;
  all += sums.lit;
  return {.points = all.count,
          .penumbra_points = sums.penumbra.count,
          .far_off = sums.far_off,
          .rmse = all.root_mean_square(),
          .bias = all.mean(),
          .penumbra_rmse = sums.penumbra.root_mean_square(),
          .penumbra_bias = sums.penumbra.mean(),
          .largest = sums.largest,
          .leaked = sums.dark.sum,
          .lost = -sums.lit.sum};
}

}  // namespace

FieldErrors field_errors(std::span<const float> reference, std::span<const float> test,
                         std::span<const std::uint8_t> surface) {
  assert(reference.size() == test.size());
  assert(surface.empty() || surface.size() == test.size());
  return errors_of(sum_blocks<Sums>(reference.size(), [&](std::size_t first, std::size_t last) {
    Sums sums;
    for (std::size_t i = first; i < last; ++i) {
      const bool counts = surface.empty() || surface[i] != 0;
      if (counts && !std::isnan(reference[i]) && !std::isnan(test[i]))
        sums.add(reference[i], test[i]);
    }
    return sums;
  }));
}

}  // namespace penumbra
