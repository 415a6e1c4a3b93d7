#include "compare/error_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "image/srgb.h"

namespace penumbra {
namespace {

// ColorBrewer 2.0: RdBu's blues from dark to light, its near white, PuOr's oranges.
constexpr Rgb8 kDiverging[] = {{5, 48, 97},     {33, 102, 172},  {67, 147, 195},  {146, 197, 222},
                               {209, 229, 240}, {247, 247, 247}, {254, 224, 182}, {253, 184, 99},
                               {224, 130, 20},  {179, 88, 6},    {127, 59, 8}};
// matplotlib's magma at 0, 32, 64, 96, 128, 159, 191, 223 and 255 of 255.
constexpr Rgb8 kMagma[] = {{0, 0, 4},      {29, 17, 71},    {81, 18, 124},
                           {131, 38, 129}, {183, 55, 121},  {229, 80, 100},
                           {251, 135, 97}, {254, 194, 135}, {252, 253, 191}};

// At `place` in [0, 1] along equally spaced colours.
template <std::size_t count>
Rgb8 interpolated(const Rgb8 (&stops)[count], float place) {
  const float at = std::clamp(place, 0.0f, 1.0f) * static_cast<float>(count - 1);
  const std::size_t stop = std::min(static_cast<std::size_t>(at), count - 2);
  const float share = at - static_cast<float>(stop);
  Rgb8 color;
  for (int c = 0; c < 3; ++c) {
    const float from = stops[stop][c], to = stops[stop + 1][c];
    color[c] = static_cast<std::uint8_t>(std::lerp(from, to, share) + 0.5f);
  }
  return color;
}

void set_linear(const Rgb8& color, float* pixel) {
  for (int c = 0; c < 3; ++c) pixel[c] = srgb_decode_table()[color[c]];
}

// Color(x) is the colour at x in [0, 1] along the bar.
template <class Color>
Image bar(int width, int height, const Color& color) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      set_linear(color((static_cast<float>(x) + 0.5f) / static_cast<float>(width)), image.at(x, y));
  return image;
}

}  // namespace

Rgb8 signed_error_color(float error, float limit) {
  if (std::isnan(error)) return kNoSurface;
  return interpolated(kDiverging, 0.5f + 0.5f * error / limit);
}

Rgb8 magnitude_color(float value) {
  return std::isnan(value) ? kNoSurface : interpolated(kMagma, value);
}

Image signed_error_map(const Image& reference, const Image& test,
                       std::span<const std::uint8_t> surface, float limit) {
  assert(reference.channels == 1 && test.channels == 1);
  assert(reference.data.size() == test.data.size());
  assert(surface.empty() || surface.size() == test.data.size());
  Image colors(test.width, test.height, 3);
  for (std::size_t i = 0; i < test.data.size(); ++i) {
    const bool counts = surface.empty() || surface[i] != 0;
    set_linear(counts ? signed_error_color(test.data[i] - reference.data[i], limit) : kNoSurface,
               colors.data.data() + 3 * i);
  }
  return colors;
}

Image magnitude_map(const Image& values) {
  assert(values.channels == 1);
  Image colors(values.width, values.height, 3);
  for (std::size_t i = 0; i < values.data.size(); ++i)
    set_linear(magnitude_color(values.data[i]), colors.data.data() + 3 * i);
  return colors;
}

Image signed_error_legend(int width, int height) {
  return bar(width, height, [](float x) { return signed_error_color(x - 0.5f, 0.5f); });
}

Image magnitude_legend(int width, int height) { return bar(width, height, magnitude_color); }

}  // namespace penumbra
