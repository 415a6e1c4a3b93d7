// Pictures in memory: linear floats, row by row from the top left, channels interleaved.
#pragma once

#include <cstddef>
#include <vector>

namespace penumbra {

struct Image {
  int width = 0, height = 0, channels = 0;
  std::vector<float> data;  ///< width · height · channels

  Image() = default;
  Image(int w, int h, int c)
      : width(w), height(h), channels(c), data(static_cast<std::size_t>(w) * h * c) {}
  float* at(int x, int y) {
    return data.data() + (static_cast<std::size_t>(y) * width + x) * channels;
  }
  const float* at(int x, int y) const {
    return data.data() + (static_cast<std::size_t>(y) * width + x) * channels;
  }
};

}  // namespace penumbra
