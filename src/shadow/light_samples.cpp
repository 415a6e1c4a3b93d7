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

// A place on the Morton curve: the bits of x and y by turns.
std::uint64_t morton(const Vec2& p) {
  const auto spread = [](float unit) {
    std::uint64_t x = static_cast<std::uint64_t>(unit * 65536);
    x = (x | x << 8) & 0x00ff00ffu;
    x = (x | x << 4) & 0x0f0f0f0fu;
    x = (x | x << 2) & 0x33333333u;
    return (x | x << 1) & 0x55555555u;
  };
  return spread(p.x) | spread(p.y) << 1;
}

}  // namespace

Vec2 concentric(Vec2 square) {
  const float x = 2 * square.x - 1, y = 2 * square.y - 1;
  if (x == 0 && y == 0) return {0, 0};
  constexpr float quarter = std::numbers::pi_v<float> / 4;
  const bool wide = std::abs(x) > std::abs(y);
  const float r = wide ? x : y, phi = wide ? quarter * (y / x) : quarter * (2 - x / y);
  return {r * std::cos(phi), r * std::sin(phi)};
}

LightSamples::LightSamples(int count, std::uint32_t seed, Order order)
    : count_(count),
      tables_(std::clamp(65536 / count, 1, 64)),
      seed_(seed),
      stride_((static_cast<std::size_t>(count) + 7) / 8 * 8) {
  for (auto* coordinate : {&square_x_, &square_y_, &disk_x_, &disk_y_})
    coordinate->reserve(stride_ * static_cast<std::size_t>(tables_));
  for (int t = 0; t < tables_; ++t) {
    const std::uint64_t scramble = hash(seed_, static_cast<std::uint64_t>(t) + 1);
    const auto sx = static_cast<std::uint32_t>(scramble),
               sy = static_cast<std::uint32_t>(scramble >> 32);
    std::vector<Vec2> squares;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count_); ++i)
      squares.push_back({unit(nested_uniform_scramble(reverse_bits(i), sx)),
                         unit(nested_uniform_scramble(sobol_y(i), sy))});
    add_table(std::move(squares), order);
  }
}

void LightSamples::add_table(std::vector<Vec2> squares, Order order) {
  if (order == Order::neighbours)
    std::stable_sort(squares.begin(), squares.end(),
                     [](const Vec2& a, const Vec2& b) { return morton(a) < morton(b); });
  const std::size_t end = square_x_.size() + stride_;
  for (const Vec2& square : squares) {
    const Vec2 disk = concentric(square);
    square_x_.push_back(square.x), square_y_.push_back(square.y);
    disk_x_.push_back(disk.x), disk_y_.push_back(disk.y);
  }
  for (auto* coordinate : {&square_x_, &square_y_, &disk_x_, &disk_y_}) coordinate->resize(end);
}

SamplePattern LightSamples::table(int t) const {
  const std::size_t first = stride_ * static_cast<std::size_t>(t);
  SamplePattern p;
  p.square_x = &square_x_[first], p.square_y = &square_y_[first];
  p.disk_x = &disk_x_[first], p.disk_y = &disk_y_[first];
  p.table = t;
  return p;
}

SamplePattern LightSamples::unshifted_pattern(std::uint64_t stream) const {
  const std::uint64_t h = hash(seed_ ^ 0x5bd1e995u, stream);
  SamplePattern p = table(static_cast<int>((h & 0xffffu) % static_cast<std::uint64_t>(tables_)));
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
