#include "shadow/light_samples.h"

#include <algorithm>
#include <numbers>

namespace penumbra {
namespace {

std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

// Second dimension of Sobol's sequence; its first is the radical inverse in base 2. Direction
// numbers of the primitive polynomial x + 1.
std::uint32_t sobol_y(std::uint32_t i) {
  std::uint32_t result = 0;
  for (std::uint32_t v = 1u << 31; i; i >>= 1, v ^= v >> 1)
    if (i & 1) result ^= v;
  return result;
}

// Laine and Karras's permutation, as tuned by Burley (2020, section 3.2): each bit is flipped
// depending on the bits below it.
std::uint32_t nested_uniform_scramble(std::uint32_t x, std::uint32_t seed) {
  x = reverse_bits(x);
  x += seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return reverse_bits(x);
}

float unit(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }

Vec2 concentric(Vec2 square) {
  const float x = 2 * square.x - 1, y = 2 * square.y - 1;
  if (x == 0 && y == 0) return {0, 0};
  constexpr float quarter = std::numbers::pi_v<float> / 4;
  const bool wide = std::abs(x) > std::abs(y);
  const float r = wide ? x : y, phi = wide ? quarter * (y / x) : quarter * (2 - x / y);
  return {r * std::cos(phi), r * std::sin(phi)};
}

}  // namespace

Vec2 SamplePattern::square_point(int i) const {
  float x = square[i].x + shift.x, y = square[i].y + shift.y;
  x -= x >= 1 ? 1.0f : 0.0f, y -= y >= 1 ? 1.0f : 0.0f;
  return {x, y};
}

LightSamples::LightSamples(int count, std::uint32_t seed)
    : count_(count), tables_(std::clamp(65536 / count, 1, 64)), seed_(seed) {
  squares_.reserve(static_cast<std::size_t>(count_) * tables_);
  for (int t = 0; t < tables_; ++t) {
    const std::uint64_t scramble = hash(seed_, static_cast<std::uint64_t>(t) + 1);
    const auto sx = static_cast<std::uint32_t>(scramble),
               sy = static_cast<std::uint32_t>(scramble >> 32);
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count_); ++i)
      squares_.push_back({unit(nested_uniform_scramble(reverse_bits(i), sx)),
                          unit(nested_uniform_scramble(sobol_y(i), sy))});
  }
  std::transform(squares_.begin(), squares_.end(), std::back_inserter(disks_), concentric);
}

SamplePattern LightSamples::unshifted_pattern(std::uint64_t stream) const {
  const std::uint64_t h = hash(seed_ ^ 0x5bd1e995u, stream);
  SamplePattern p;
  p.table = static_cast<int>((h & 0xffffu) % static_cast<std::uint64_t>(tables_));
  p.square = table(p.table);
  p.disk = &disks_[static_cast<std::size_t>(p.table) * count_];
  const float angle = 2 * std::numbers::pi_v<float> * unit(static_cast<std::uint32_t>(h >> 32));
  p.cosine = std::cos(angle), p.sine = std::sin(angle);
  return p;
}

SamplePattern LightSamples::pattern(std::uint64_t stream) const {
  SamplePattern p = unshifted_pattern(stream);
  const std::uint64_t h = hash(stream, seed_ ^ 0x2545f491u);
  p.shift = {unit(static_cast<std::uint32_t>(h)), unit(static_cast<std::uint32_t>(h >> 32))};
  return p;
}

}  // namespace penumbra
