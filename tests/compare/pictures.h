// Pictures for tests.
#pragma once

#include <cstdint>
#include <functional>

#include "image/image.h"

namespace penumbra::test {

inline Image flat(int width, int height, float r, float g, float b) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      float* p = image.at(x, y);
      p[0] = r, p[1] = g, p[2] = b;
    }
  return image;
}

/// Values in [0, 1) that no structure connects: of Knuth's multiplicative congruential generator.
inline Image noise(int width, int height, int channels, std::uint32_t seed) {
  Image image(width, height, channels);
  std::uint64_t state = seed * 2654435761u + 1;
  for (float& value : image.data) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    value = static_cast<float>(state >> 40) * 0x1p-24f;
  }
  return image;
}

/// A picture of soft and sharp parts: noise of `seed` on a ramp with a bright disc.
inline Image scenery(int width, int height, std::uint32_t seed) {
  Image image = noise(width, height, 3, seed);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        const int dx = x - width / 3, dy = y - height / 2;
        const bool inside = dx * dx + dy * dy < height * height / 9;
        const float ramp = static_cast<float>(x + c * y) / static_cast<float>(width + 2 * height);
        float& value = image.at(x, y)[c];
        value = 0.2f * value + (inside ? 0.7f : 0.6f * ramp);
      }
  return image;
}

}  // namespace penumbra::test
