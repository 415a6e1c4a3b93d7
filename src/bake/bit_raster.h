// One bit a texel: set where a sample of a light does not reach.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace penumbra::bake {

/// Rows of 64-bit words; texel i of a row is bit i % 64 of word i / 64.
class BitRaster {
 public:
  /// Rows past the last that may be written.
  static constexpr int spare_rows = 8;

  /// Clears it too.
  void resize(int width, int height) {
    width_ = width, height_ = height, words_ = (width + 63) / 64;
    bits_.assign(static_cast<std::size_t>(words_) * (height + spare_rows), 0);
  }
  void clear() { std::fill(bits_.begin(), bits_.end(), 0); }

  int width() const { return width_; }
  int height() const { return height_; }
  int words() const { return words_; }
  std::uint64_t* row(int j) { return &bits_[static_cast<std::size_t>(words_) * j]; }
  const std::uint64_t* row(int j) const { return &bits_[static_cast<std::size_t>(words_) * j]; }
  bool at(int i, int j) const { return row(j)[i / 64] >> (i % 64) & 1; }
  void set(int i, int j) { row(j)[i / 64] |= std::uint64_t{1} << (i % 64); }

  /// Sets texels first to last of a row of words; 0 ≤ first ≤ last < width.
  static void fill(std::uint64_t* row, int first, int last) {
    const int word = first >> 6, end = last >> 6;
    const std::uint64_t head = ~std::uint64_t{0} << (first & 63);
    const std::uint64_t tail = ~std::uint64_t{0} >> (63 - (last & 63));
    if (word == end) {
      row[word] |= head & tail;
      return;
    }
    row[word] |= head;
    for (int w = word + 1; w < end; ++w) row[w] = ~std::uint64_t{0};
    row[end] |= tail;
  }
  /// The same with any first and last: cut to the row.
  void fill_cut(int j, int first, int last) {
    first = std::max(first, 0), last = std::min(last, width_ - 1);
    if (first <= last) fill(row(j), first, last);
  }

 private:
  int width_ = 0, height_ = 0, words_ = 0;
  std::vector<std::uint64_t> bits_;
};

}  // namespace penumbra::bake
