#include "bake/sample_bits.h"

#include <algorithm>
#include <bit>

namespace penumbra::bake {
namespace {

/// `count` ≤ 8 bits from bit `at` on.
unsigned bits_at(const std::vector<std::uint8_t>& bytes, std::size_t at, unsigned count) {
  const std::size_t byte = at / 8;
  unsigned word = bytes[byte];
  if (byte + 1 < bytes.size()) word |= unsigned{bytes[byte + 1]} << 8;
  return word >> (at % 8) & ((1u << count) - 1);
}

}  // namespace

void SampleBits::set_row(std::size_t first, int width, std::size_t sample,
                         const std::uint64_t* hidden) {
  for (int i = 0; i < width; i += 64) {
    std::uint64_t visible = hidden ? ~hidden[i / 64] : ~std::uint64_t{0};
    if (width - i < 64) visible &= (std::uint64_t{1} << (width - i)) - 1;
    for (; visible != 0; visible &= visible - 1) {
      const auto texel = first + static_cast<std::size_t>(i + std::countr_zero(visible));
      const std::size_t bit = texel * samples_ + sample;
      bytes_[bit / 8] |= static_cast<std::uint8_t>(1u << (bit % 8));
    }
  }
}

void SampleBits::copy(std::size_t to, const SampleBits& from, std::size_t first,
                      std::size_t count) {
  std::size_t out = to * samples_, in = first * samples_;
  for (const std::size_t end = out + count * samples_; out < end;) {
    const auto some = static_cast<unsigned>(std::min<std::size_t>(8 - out % 8, end - out));
    bytes_[out / 8] |= static_cast<std::uint8_t>(bits_at(from.bytes_, in, some) << (out % 8));
    out += some, in += some;
  }
}

}  // namespace penumbra::bake
