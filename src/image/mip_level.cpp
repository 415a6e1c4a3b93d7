#include "image/mip_level.h"

#include <algorithm>
#include <cmath>

#include "image/srgb.h"

namespace penumbra {
namespace {

// The texels of a row or column that a new texel covers, and how much of each.
struct Cover {
  int first = 0, count = 0;
  float weight[3] = {0, 0, 0};
};

std::vector<Cover> covers(int size, int new_size) {
  std::vector<Cover> all(static_cast<std::size_t>(new_size));
  const double step = static_cast<double>(size) / new_size;
  for (int i = 0; i < new_size; ++i) {
    Cover& cover = all[i];
    const double begin = i * step, end = (i + 1) * step;
    cover.first = static_cast<int>(begin);
    for (int k = cover.first; k < std::min(size, cover.first + 3) && k < end; ++k) {
      const double overlap = std::min(end, k + 1.0) - std::max<double>(begin, k);
      cover.weight[cover.count++] = static_cast<float>(overlap / step);
    }
  }
  return all;
}

struct Sum {
  float channel[4] = {0, 0, 0, 0};
};

Sum weighted_sum(const TextureImage& image, const Cover& across, const Cover& down,
                 const float* color, const float* unit) {
  Sum sum;
  for (int j = 0; j < down.count; ++j) {
    const std::size_t row = static_cast<std::size_t>(down.first + j) * image.width;
    const std::uint8_t* texel = image.rgba.data() + (row + across.first) * 4;
    for (int i = 0; i < across.count; ++i, texel += 4) {
      const float weight = down.weight[j] * across.weight[i];
      for (int c = 0; c < 3; ++c) sum.channel[c] += weight * color[texel[c]];
      sum.channel[3] += weight * unit[texel[3]];
    }
  }
  return sum;
}

std::uint8_t unit_code(float value) {
  return static_cast<std::uint8_t>(std::clamp(value * 255 + 0.5f, 0.0f, 255.0f));
}

}  // namespace

TextureImage halved(const TextureImage& image, bool srgb) {
  TextureImage half;
  half.width = std::max(1, image.width / 2);
  half.height = std::max(1, image.height / 2);
  half.rgba.resize(static_cast<std::size_t>(half.width) * half.height * 4);
  const float* unit = unit_decode_table();
  const float* color = srgb ? srgb_decode_table() : unit;
  const std::vector<Cover> across = covers(image.width, half.width);
  std::uint8_t* out = half.rgba.data();
  for (const Cover& down : covers(image.height, half.height))
    for (const Cover& cover : across) {
      const Sum sum = weighted_sum(image, cover, down, color, unit);
      for (int c = 0; c < 3; ++c)
        *out++ = srgb ? srgb_encoder()(sum.channel[c]) : unit_code(sum.channel[c]);
      *out++ = unit_code(sum.channel[3]);
    }
  return half;
}

}  // namespace penumbra
