// Points of lights, well spread: tables made once, turned or shifted for every receiver.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace penumbra {

/// A well-mixed 64-bit hash of two numbers (the finaliser of SplitMix64, Steele et al. 2014).
inline std::uint64_t hash(std::uint64_t a, std::uint64_t b) {
  std::uint64_t x = a * 0x9e3779b97f4a7c15u + b;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// One receiver's pattern: which table, and how it is turned (disks) or shifted (squares).
struct SamplePattern {
  const Vec2* square = nullptr;  ///< count points of the unit square
  const Vec2* disk = nullptr;    ///< the same points on the unit disk, area kept
  float cosine = 1, sine = 0;    ///< turn
  Vec2 shift;                    ///< in [0, 1)²
  int table = 0;                 ///< its number
  Vec2 square_point(int i) const;
  Vec2 disk_point(int i) const {
    return {cosine * disk[i].x - sine * disk[i].y, sine * disk[i].x + cosine * disk[i].y};
  }
};

/// Tables of `count` points each: the first two dimensions of Sobol's sequence, Owen-scrambled by
/// hashing (Burley 2020, Practical Hash-based Owen Scrambling), so that every prefix of a power of
/// two is stratified. Squares go to disks by Shirley and Chiu's concentric map (1997). Immutable;
/// thread-safe.
class LightSamples {
 public:
  LightSamples(int count, std::uint32_t seed);
  int count() const { return count_; }
  /// The pattern of a stream: same stream, same points.
  SamplePattern pattern(std::uint64_t stream) const;
  /// The same without a shift: points of the square stay in their cells.
  SamplePattern unshifted_pattern(std::uint64_t stream) const;
  int table_count() const { return tables_; }
  const Vec2* table(int t) const { return &squares_[static_cast<std::size_t>(t) * count_]; }

 private:
  int count_, tables_;
  std::uint64_t seed_;
  std::vector<Vec2> squares_, disks_;
};

}  // namespace penumbra
