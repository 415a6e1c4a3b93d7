#include "image/png_bytes.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/error.h"
#include "image/srgb.h"

namespace penumbra {
namespace {

std::string encode(int width, int height, png_uint_32 format, const void* pixels) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(width);
  header.height = static_cast<png_uint_32>(height);
  header.format = format;
  header.flags = PNG_IMAGE_FLAG_FAST;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(header), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, pixels, 0, nullptr) == 0)
    throw WorkError(std::string("an image cannot be encoded (") + header.message + ")",
                    "choose coarser texels");
  bytes.resize(size);
  return bytes;
}

}  // namespace

std::string encode_png(const Image& image, float exposure_ev) {
  const SrgbEncoder& to_code = srgb_encoder();
  const float scale = std::exp2(exposure_ev);
  std::vector<png_byte> codes(image.data.size());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const bool is_alpha = image.channels == 4 && i % 4 == 3;
    const float x = image.data[i];
    codes[i] = is_alpha ? static_cast<png_byte>(std::clamp(x, 0.0f, 1.0f) * 255 + 0.5f)
                        : to_code(x * scale);
  }
  return encode(image.width, image.height, image.channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB,
                codes.data());
}

std::string encode_png(int width, int height, const std::uint8_t* rgba) {
  return encode(width, height, PNG_FORMAT_RGBA, rgba);
}

std::string encode_grey_png(const Image& image) {
  std::vector<png_byte> codes(image.data.size());
  for (std::size_t i = 0; i < codes.size(); ++i)
    codes[i] = static_cast<png_byte>(std::clamp(image.data[i], 0.0f, 1.0f) * 255 + 0.5f);
  return encode(image.width, image.height, PNG_FORMAT_GRAY, codes.data());
}

std::string encode_linear_png(const Image& image, float white) {
  std::vector<png_uint_16> codes(image.data.size());
  for (std::size_t i = 0; i < codes.size(); ++i)
    codes[i] =
        static_cast<png_uint_16>(std::clamp(image.data[i] / white, 0.0f, 1.0f) * 65535 + 0.5f);
  return encode(image.width, image.height, PNG_FORMAT_LINEAR_RGB, codes.data());
}

}  // namespace penumbra
