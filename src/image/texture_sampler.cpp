#include "image/texture_sampler.h"

#include <algorithm>
#include <cmath>

#include "image/mip_level.h"
#include "image/srgb.h"

namespace penumbra {
namespace {

// Brings a coordinate into [0, 2) for mirror and about [0, 1) otherwise, where a float still has
// texel precision; clamp keeps a little of the outside.
float reduced_coordinate(float u, Wrap wrap) {
  if (!std::isfinite(u)) return 0;
  switch (wrap) {
    case Wrap::clamp:
      return std::clamp(u, -1.0f, 2.0f);
    case Wrap::mirror:
      return u - 2 * std::floor(u / 2);
    case Wrap::repeat:
      break;
  }
  return u - std::floor(u);
}

// Texel number i, which may lie one image outside on either side, back inside.
int wrapped_index(int i, int size, Wrap wrap) {
  switch (wrap) {
    case Wrap::clamp:
      return std::clamp(i, 0, size - 1);
    case Wrap::mirror: {
      const int turn = (i % (2 * size) + 2 * size) % (2 * size);
      return turn < size ? turn : 2 * size - 1 - turn;
    }
    case Wrap::repeat:
      break;
  }
  return (i % size + size) % size;
}

// The two neighbours of a coordinate along one axis, and the second's weight.
struct Taps {
  int first, second;
  float weight;
};

Taps linear_taps(float u, int size, Wrap wrap) {
  const float x = reduced_coordinate(u, wrap) * static_cast<float>(size) - 0.5f;
  const float floor = std::floor(x);
  const int i = static_cast<int>(floor);
  return {wrapped_index(i, size, wrap), wrapped_index(i + 1, size, wrap), x - floor};
}

Taps nearest_tap(float u, int size, Wrap wrap) {
  const float x = reduced_coordinate(u, wrap) * static_cast<float>(size);
  const int i = wrapped_index(static_cast<int>(std::floor(x)), size, wrap);
  return {i, i, 0};
}

struct Corners {
  const std::uint8_t* texel[4];
  float weight[4];
};

Corners corners_at(const TextureImage& image, const TextureSlot& slot, const Vec2& uv,
                   bool nearest) {
  const auto taps = nearest ? nearest_tap : linear_taps;
  const Taps s = taps(uv.x, image.width, slot.wrap_s), t = taps(uv.y, image.height, slot.wrap_t);
  const auto texel = [&](int x, int y) {
    return image.rgba.data() + (static_cast<std::size_t>(y) * image.width + x) * 4;
  };
  return {{texel(s.first, t.first), texel(s.second, t.first), texel(s.first, t.second),
           texel(s.second, t.second)},
          {(1 - s.weight) * (1 - t.weight), s.weight * (1 - t.weight), (1 - s.weight) * t.weight,
           s.weight * t.weight}};
}

Rgba filtered(const Corners& corners, const float* decode, const float* unit) {
  Rgba sum{{0, 0, 0}, 0};
  for (int k = 0; k < 4; ++k) {
    const std::uint8_t* texel = corners.texel[k];
    sum.color += Vec3(decode[texel[0]], decode[texel[1]], decode[texel[2]]) * corners.weight[k];
    sum.alpha += unit[texel[3]] * corners.weight[k];
  }
  return sum;
}

Rgba mix(const Rgba& a, const Rgba& b, float t) {
  return {a.color * (1 - t) + b.color * t, a.alpha * (1 - t) + b.alpha * t};
}

}  // namespace

Vec2 transform_uv(const TextureSlot& slot, const Vec2& uv) {
  const float u = uv.x * slot.scale.x, v = uv.y * slot.scale.y;
  if (slot.rotation == 0) return {slot.offset.x + u, slot.offset.y + v};
  const float c = std::cos(slot.rotation), s = std::sin(slot.rotation);
  return {slot.offset.x + c * u + s * v, slot.offset.y - s * u + c * v};
}

float sample_alpha(const TextureImage& image, const TextureSlot& slot, const Vec2& uv) {
  const Corners corners = corners_at(image, slot, transform_uv(slot, uv), slot.nearest);
  float alpha = 0;
  for (int k = 0; k < 4; ++k) alpha += static_cast<float>(corners.texel[k][3]) * corners.weight[k];
  return alpha / 255;
}

TextureSampler::TextureSampler(const TextureImage& image, bool srgb)
    : base_(image), decode_(srgb ? srgb_decode_table() : unit_decode_table()) {
  for (const TextureImage* last = &base_; last->width > 1 || last->height > 1;
       last = &reduced_.back())
    reduced_.push_back(halved(*last, srgb));
}

std::size_t TextureSampler::memory_bytes() const {
  std::size_t bytes = 0;
  for (const TextureImage& level : reduced_) bytes += level.rgba.size();
  return bytes;
}

// The longer of the images of the two mesh axes: what could alias is filtered, at the price of some
// blur where the texture is stretched.
float TextureSampler::width_in_texels(const TextureSlot& slot, float uv_width) const {
  const float c = std::cos(slot.rotation), s = std::sin(slot.rotation);
  const float w = static_cast<float>(base_.width), h = static_cast<float>(base_.height);
  const float along_u = std::abs(slot.scale.x) * std::hypot(c * w, s * h);
  const float along_v = std::abs(slot.scale.y) * std::hypot(s * w, c * h);
  return uv_width * std::max(along_u, along_v);
}

Rgba TextureSampler::sample(const TextureSlot& slot, const Vec2& uv, float uv_width) const {
  const Vec2 at = transform_uv(slot, uv);
  const float* unit = unit_decode_table();
  const float texels = width_in_texels(slot, uv_width);
  if (!(texels > 1) || reduced_.empty())
    return filtered(corners_at(base_, slot, at, slot.nearest), decode_, unit);
  const auto lookup = [&](int level) {
    const TextureImage& image = level == 0 ? base_ : reduced_[level - 1];
    return filtered(corners_at(image, slot, at, false), decode_, unit);
  };
  const float last = static_cast<float>(reduced_.size());
  const float detail = std::min(std::log2(texels), last);
  const int level = std::min(static_cast<int>(detail), static_cast<int>(reduced_.size()) - 1);
  return mix(lookup(level), lookup(level + 1), detail - static_cast<float>(level));
}

}  // namespace penumbra
