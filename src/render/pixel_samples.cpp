#include "render/pixel_samples.h"

#include "render/hash.h"

namespace penumbra {
namespace {

float below_one(float x) { return std::min(x, 0x1.fffffep-1f); }

float wrap(float x) { return below_one(x - std::floor(x)); }

float radical_inverse_2(std::uint32_t i) {
  i = (i << 16) | (i >> 16);
  i = ((i & 0x00ff00ffu) << 8) | ((i & 0xff00ff00u) >> 8);
  i = ((i & 0x0f0f0f0fu) << 4) | ((i & 0xf0f0f0f0u) >> 4);
  i = ((i & 0x33333333u) << 2) | ((i & 0xccccccccu) >> 2);
  i = ((i & 0x55555555u) << 1) | ((i & 0xaaaaaaaau) >> 1);
  return static_cast<float>(i >> 8) * 0x1p-24f;
}

Vec2 jittered(int index, int side, std::uint64_t hash) {
  const std::uint64_t a = mix64(hash, static_cast<std::uint64_t>(index));
  const float scale = 1.0f / static_cast<float>(side);
  return {below_one((static_cast<float>(index % side) + unit_float(a)) * scale),
          below_one((static_cast<float>(index / side) + unit_float(mix64(a))) * scale)};
}

Vec2 hammersley(int index, int count, std::uint64_t hash) {
  const float x = static_cast<float>(index) / static_cast<float>(count);
  return {wrap(x + unit_float(hash)),
          wrap(radical_inverse_2(static_cast<std::uint32_t>(index)) + unit_float(mix64(hash)))};
}

}  // namespace

Vec2 pixel_sample(int index, int count, std::uint64_t pixel_hash) {
  if (count <= 1) return {0.5f, 0.5f};
  const int side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(count))));
  return side * side == count ? jittered(index, side, pixel_hash)
                              : hammersley(index, count, pixel_hash);
}

}  // namespace penumbra
