#include <climits>
#include <cstdlib>
#include <memory>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_NO_THREAD_LOCALS
#define STBI_NO_FAILURE_STRINGS
#define STBI_MAX_DIMENSIONS 16384
#include <stb_image.h>

#include "image/texture.h"

namespace penumbra {
namespace {

struct FreePixels {
  void operator()(stbi_uc* pixels) const { std::free(pixels); }
};

// Deflate expands a byte to at most 1032, and a PNG of one bit a pixel makes eight pixels of each;
// no other format here reaches that. So a header that promises more than this lies, and is refused
// before anything is allocated for it.
constexpr std::size_t kPixelsPerByte = 8256;

bool is_plausible(int width, int height, std::size_t file_size) {
  if (width <= 0 || height <= 0 || width > STBI_MAX_DIMENSIONS || height > STBI_MAX_DIMENSIONS)
    return false;
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) / kPixelsPerByte <=
         file_size;
}

void set_white(TextureImage& out) {
  out.width = out.height = 1;
  out.rgba.assign(4, 255);
}

}  // namespace

bool decode_texture(const std::uint8_t* bytes, std::size_t size, TextureImage& out) {
  set_white(out);
  if (size == 0 || size > INT_MAX) return false;
  const int length = static_cast<int>(size);
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(bytes, length, &width, &height, &channels) ||
      !is_plausible(width, height, size))
    return false;
  const std::unique_ptr<stbi_uc, FreePixels> pixels(
      stbi_load_from_memory(bytes, length, &width, &height, &channels, 4));
  if (!pixels) return false;
  out.width = width;
  out.height = height;
  out.rgba.assign(pixels.get(), pixels.get() + static_cast<std::size_t>(width) * height * 4);
  return true;
}

}  // namespace penumbra
