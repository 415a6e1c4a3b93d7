#include "render/glsl/image_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/mip_level.h"
#include "sdf/glsl/numbers.h"

namespace penumbra {

using sdf::number;

std::size_t ImageBytes::add(const TextureImage& image, bool srgb) {
  const std::size_t first = bytes_.size() / 4;
  TextureImage level = image;
  for (;; level = halved(level, srgb)) {
    bytes_.insert(bytes_.end(), level.rgba.begin(), level.rgba.end());
    if (level.width == 1 && level.height == 1) return first;
  }
}

std::string ImageBytes::lookup(const std::vector<TextureImage>& images, const TextureSlot& slot,
                               bool srgb, const std::string& uv, const std::string& width) {
  const TextureImage& image = images[static_cast<std::size_t>(slot.image)];
  const auto [at, is_new] = first_.try_emplace({slot.image, srgb});
  if (is_new) at->second = add(image, srgb);
  const double c = std::cos(slot.rotation), s = std::sin(slot.rotation);
  const double w = image.width, h = image.height;
  const double texels = std::max(std::abs(slot.scale.x) * std::hypot(c * w, s * h),
                                 std::abs(slot.scale.y) * std::hypot(s * w, c * h));
  return fmt::format(
      "pnb_image({}, ivec2({}, {}), ivec2({}, {}), {}, {}, vec2({}, {}) + mat2({}, {}, {}, {}) * "
      "({} * "
      "vec2({}, {})), {} * {})",
      at->second, image.width, image.height, static_cast<int>(slot.wrap_s),
      static_cast<int>(slot.wrap_t), slot.nearest, srgb, number(slot.offset.x),
      number(slot.offset.y), number(c), number(-s), number(s), number(c), uv, number(slot.scale.x),
      number(slot.scale.y), width, number(texels));
}

}  // namespace penumbra
