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

/// A point of the unit square on the unit disk, areas and neighbourhoods kept (Shirley and Chiu
/// 1997, A Low Distortion Map Between Disk and Square).
Vec2 concentric(Vec2 square);

/// One receiver's pattern: which table, and how it is turned (disks) or shifted (squares).
struct SamplePattern {
  const float *square_x = nullptr, *square_y = nullptr;  ///< count points of the unit square
  const float *disk_x = nullptr, *disk_y = nullptr;      ///< the same on the unit disk, area kept
  float cosine = 1, sine = 0;                            ///< turn
  Vec2 shift;                                            ///< in [0, 1)²
  int table = 0;                                         ///< its number
};

/// Tables of `count` points each: the first two dimensions of Sobol's sequence, Owen-scrambled by
/// hashing (Burley 2020, Practical Hash-based Owen Scrambling), so that every prefix of a power of
/// two is stratified; or the same points ordered so that neighbours in the table are neighbours on
/// the light, whose rays stay together. Squares go to disks by Shirley and Chiu's concentric map
/// (1997). Coordinates can be read up to a multiple of eight points, zeros beyond the last.
/// Immutable; thread-safe.
class LightSamples {
 public:
  enum class Order : std::uint8_t { sequence, neighbours };

  LightSamples(int count, std::uint32_t seed, Order order = Order::sequence);
  int count() const { return count_; }
  /// The pattern of a stream: same stream, same points.
  SamplePattern pattern(std::uint64_t stream) const;
  /// The same without a shift: points of the square stay in their cells.
  SamplePattern unshifted_pattern(std::uint64_t stream) const;
  int table_count() const { return tables_; }
  /// Table `t`, neither turned nor shifted.
  SamplePattern table(int t) const;

 private:
  void add_table(std::vector<Vec2> squares, Order order);

  int count_, tables_;
  std::uint64_t seed_;
  std::size_t stride_;
  std::vector<float> square_x_, square_y_, disk_x_, disk_y_;
};

}  // namespace penumbra
