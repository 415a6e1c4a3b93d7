#include "image/texture.h"

#include <gtest/gtest.h>

#include <random>

#include "base/atomic_file.h"
#include "image/image.h"
#include "image/png.h"
#include "support/temporary_folder.h"

namespace penumbra {
namespace {

bool decode(const std::string& bytes, TextureImage& out) {
  return decode_texture(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), out);
}

void expect_white(const TextureImage& image) {
  EXPECT_EQ(image.width, 1);
  EXPECT_EQ(image.height, 1);
  EXPECT_EQ(image.rgba, std::vector<std::uint8_t>(4, 255));
}

std::string png_bytes(const Image& image) {
  const test::TemporaryFolder folder;
  write_png(folder / "a.png", image);
  return read_file(folder / "a.png");
}

// Big-endian, as PNG headers have it.
void put32(std::string& bytes, std::size_t at, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(value >> (24 - 8 * i));
}

TEST(DecodeTexture, ReadsPng) {
  Image image(3, 2, 3);
  image.at(2, 0)[0] = 1;
  image.at(0, 1)[2] = 1;
  TextureImage out;
  ASSERT_TRUE(decode(png_bytes(image), out));
  EXPECT_EQ(out.width, 3);
  EXPECT_EQ(out.height, 2);
  const std::vector<std::uint8_t> expected{0, 0, 0,   255, 0, 0, 0, 255, 255, 0, 0, 255,
                                           0, 0, 255, 255, 0, 0, 0, 255, 0,   0, 0, 255};
  EXPECT_EQ(out.rgba, expected);
}

TEST(DecodeTexture, ReadsBmp) {
  // A 1 × 1 bitmap of 24 bits: blue, green, red.
  const unsigned char bytes[] = {'B', 'M', 58, 0, 0, 0, 0, 0, 0, 0,  54, 0,  0, 0,  40,
                                 0,   0,   0,  1, 0, 0, 0, 1, 0, 0,  0,  1,  0, 24, 0,
                                 0,   0,   0,  0, 4, 0, 0, 0, 0, 0,  0,  0,  0, 0,  0,
                                 0,   0,   0,  0, 0, 0, 0, 0, 0, 30, 20, 10, 0};
  TextureImage out;
  ASSERT_TRUE(decode_texture(bytes, sizeof bytes, out));
  EXPECT_EQ(out.rgba, (std::vector<std::uint8_t>{10, 20, 30, 255}));
}

TEST(DecodeTexture, OtherBytesAreWhite) {
  TextureImage out;
  EXPECT_FALSE(decode("", out));
  expect_white(out);
  EXPECT_FALSE(decode("GIF89a, which is a picture, but none of ours", out));
  expect_white(out);
}

TEST(DecodeTexture, HeadersThatPromiseTooMuchAreRefused) {
  std::string bytes = png_bytes(Image(4, 4, 3));
  TextureImage out;
  put32(bytes, 16, 16384), put32(bytes, 20, 16384);
  EXPECT_FALSE(decode(bytes, out));
  expect_white(out);
  put32(bytes, 16, 0x7fffffff), put32(bytes, 20, 1);
  EXPECT_FALSE(decode(bytes, out));
  put32(bytes, 16, 0), put32(bytes, 20, 4);
  EXPECT_FALSE(decode(bytes, out));
}

TEST(DecodeTexture, DamagedFilesDoNotCrash) {
  Image image(64, 64, 4);
  std::mt19937 random(3);
  for (float& x : image.data) x = static_cast<float>(random() % 256) / 255;
  const std::string good = png_bytes(image);
  for (int i = 0; i < 500; ++i) {
    std::string bad = good;
    for (int k = 0; k < 4; ++k) bad[random() % bad.size()] = static_cast<char>(random());
    if (i % 3 == 0) bad.resize(random() % bad.size());
    TextureImage out;
    if (decode(bad, out))
      EXPECT_EQ(out.rgba.size(), static_cast<std::size_t>(out.width) * out.height * 4);
    else
      expect_white(out);
  }
}

}  // namespace
}  // namespace penumbra
