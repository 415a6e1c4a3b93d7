// Which part of a light is seen: a grid over its parameter square, refined where it disagrees.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace penumbra {

/// A square of g × g bits, g a power of two up to 64; row y is rows[y], column x its bit x. Rows
/// from g on mean nothing.
struct BitGrid {
  int g = 1;
  std::uint64_t rows[64];

  /// Empty.
  explicit BitGrid(int size = 64) : g(size) { std::fill_n(rows, g, 0); }
  BitGrid(const BitGrid& b) : g(b.g) { std::copy_n(b.rows, g, rows); }
  BitGrid& operator=(const BitGrid& b) {
    if (this == &b) return *this;
    g = b.g;
    std::copy_n(b.rows, g, rows);
    return *this;
  }
  static BitGrid full(int size) {
    BitGrid out(size);
    std::fill_n(out.rows, size, out.full_row());
    return out;
  }

  bool at(int x, int y) const { return rows[y] >> x & 1; }
  void set(int x, int y, bool value) {
    rows[y] = (rows[y] & ~(std::uint64_t{1} << x)) | std::uint64_t{value} << x;
  }
  int count() const {
    // As many rows to a word as it holds: counting costs more than packing.
    const int rows_a_word = std::min(64 / g, g);
    int n = 0;
    for (int y = 0; y < g;) {
      std::uint64_t word = 0;
      for (int i = 0; i < rows_a_word; ++i, ++y) word |= rows[y] << (i * g);
      n += std::popcount(word);
    }
    return n;
  }
  std::uint64_t full_row() const {
    return g == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << g) - 1;
  }
  BitGrid& operator&=(const BitGrid& b) {
    for (int y = 0; y < g; ++y) rows[y] &= b.rows[y];
    return *this;
  }

  /// The same at twice the resolution: each bit four times.
  BitGrid doubled() const {
    BitGrid out(2 * g);
    for (int y = 0; y < g; ++y) {
      std::uint64_t x = rows[y];
      x = (x | x << 16) & 0x0000ffff0000ffffu;
      x = (x | x << 8) & 0x00ff00ff00ff00ffu;
      x = (x | x << 4) & 0x0f0f0f0f0f0f0f0fu;
      x = (x | x << 2) & 0x3333333333333333u;
      x = (x | x << 1) & 0x5555555555555555u;
      out.rows[2 * y] = out.rows[2 * y + 1] = x | x << 1;
    }
    return out;
  }

  /// Cells that differ from any of their eight neighbours.
  BitGrid edges() const {
    BitGrid out(g);
    const std::uint64_t full = full_row(), last = std::uint64_t{1} << (g - 1);
    // A cell is alike if it and all round it are 1, or all are 0.
    std::uint64_t any[64], every[64];
    for (int y = 0; y < g; ++y) {
      const std::uint64_t r = rows[y];
      const std::uint64_t left = ((r << 1) | (r & 1)) & full, right = (r >> 1) | (r & last);
      any[y] = r | left | right, every[y] = r & left & right;
    }
    for (int y = 0; y < g; ++y) {
      const int above = std::max(y - 1, 0), below = std::min(y + 1, g - 1);
      out.rows[y] = (any[above] | any[y] | any[below]) & ~(every[above] & every[y] & every[below]);
    }
    return out;
  }
};

}  // namespace penumbra
