// Which part of a light is seen: a grid over its parameter square, refined where it disagrees.
#pragma once

#include <bit>
#include <cstdint>

namespace penumbra {

/// A square of g × g bits, g a power of two up to 64; row y is rows[y], column x its bit x.
struct BitGrid {
  int g = 1;
  std::uint64_t rows[64] = {};

  bool at(int x, int y) const { return rows[y] >> x & 1; }
  void set(int x, int y, bool value) {
    rows[y] = (rows[y] & ~(std::uint64_t{1} << x)) | std::uint64_t{value} << x;
  }
  int count() const {
    int n = 0;
    for (int y = 0; y < g; ++y) n += std::popcount(rows[y]);
    return n;
  }
  std::uint64_t full_row() const {
    return g == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << g) - 1;
  }
  bool all_equal() const { return count() == 0 || count() == g * g; }

  /// The same at twice the resolution: each bit four times.
  BitGrid doubled() const {
    BitGrid out;
    out.g = 2 * g;
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
    BitGrid out;
    out.g = g;
    const std::uint64_t full = full_row(), last = std::uint64_t{1} << (g - 1);
    const auto left = [&](std::uint64_t r) { return ((r << 1) | (r & 1)) & full; };
    const auto right = [&](std::uint64_t r) { return (r >> 1) | (r & last); };
    for (int y = 0; y < g; ++y) {
      const std::uint64_t r = rows[y];
      for (const int n : {y > 0 ? y - 1 : y, y, y + 1 < g ? y + 1 : y}) {
        const std::uint64_t o = rows[n];
        out.rows[y] |= (r ^ o) | (r ^ left(o)) | (r ^ right(o));
      }
    }
    return out;
  }
};

}  // namespace penumbra
