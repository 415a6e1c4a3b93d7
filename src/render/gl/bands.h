// Large pictures in pieces, so that no driver's watchdog ends a draw.
#pragma once

#include <algorithm>
#include <chrono>

namespace penumbra {

/// Bands of whole rows from the bottom of the picture up. The first has 16 rows; each next one has
/// as many as should take a quarter of a second, at most four times as many as the last. Widths
/// and heights of targets stay within `longest_side`, their pixels within four million.
class Bands {
 public:
  Bands(int width, int height, int longest_side)
      : height_(height),
        most_(std::clamp(4'000'000 / std::max(width, 1), 1, std::min(height, longest_side))),
        rows_(std::min(16, most_)) {}

  bool done() const { return from_ >= height_; }
  int from() const { return from_; }
  int rows() const { return std::min(rows_, height_ - from_); }
  /// The most rows that any band will have.
  int most_rows() const { return most_; }

  /// The present band took so long for `draws` draws; to the next one.
  void next(double seconds, int draws) {
    constexpr double wanted = 0.25;
    const int drawn = rows();
    from_ += drawn;
    const double fit = wanted * draws / std::max(seconds, 1e-6) * drawn;
    rows_ = static_cast<int>(std::clamp(fit, 1.0, std::min<double>(4.0 * drawn, most_)));
    if (rows_ > 1) rows_ &= ~1;  // whole pairs: derivatives are taken over 2 × 2 pixels
  }

 private:
  int height_, most_, rows_, from_ = 0;
};

}  // namespace penumbra
