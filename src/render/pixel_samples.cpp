#include "render/pixel_samples.h"

#include <bit>
#include <cstdint>

namespace penumbra {
namespace {

float radical_inverse_2(std::uint32_t i) {
  i = (i << 16) | (i >> 16);
  i = ((i & 0x00ff00ffu) << 8) | ((i & 0xff00ff00u) >> 8);
  i = ((i & 0x0f0f0f0fu) << 4) | ((i & 0xf0f0f0f0u) >> 4);
  i = ((i & 0x33333333u) << 2) | ((i & 0xccccccccu) >> 2);
  i = ((i & 0x55555555u) << 1) | ((i & 0xaaaaaaaau) >> 1);
  return static_cast<float>(i >> 8) * 0x1p-24f;
}

}  // namespace

Vec2 pixel_sample(int index, int count) {
  const auto rows = static_cast<float>(std::bit_ceil(static_cast<std::uint32_t>(count)));
  return {(static_cast<float>(index) + 0.5f) / static_cast<float>(count),
          radical_inverse_2(static_cast<std::uint32_t>(index)) + 0.5f / rows};
}

}  // namespace penumbra
