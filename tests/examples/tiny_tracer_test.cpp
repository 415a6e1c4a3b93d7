#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

/// The picture's samples, three a pixel, under a light of `diameter`.
std::vector<unsigned char> traced(const std::string& diameter) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("tiny_tracer_" + diameter + "_" + std::to_string(std::rand()) + ".ppm");
  const std::string command = TINY_TRACER " " + file.string() + " " + diameter;
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::ifstream in(file, std::ios::binary);
  std::string magic;
  int width = 0, height = 0, most = 0;
  in >> magic >> width >> height >> most;
  in.get();
  EXPECT_EQ(magic, "P6");
  std::vector<unsigned char> samples(3u * static_cast<size_t>(width * height));
  in.read(reinterpret_cast<char*>(samples.data()), static_cast<std::streamsize>(samples.size()));
  EXPECT_TRUE(in);
  std::filesystem::remove(file);
  return samples;
}

/// Pixels that a light of `diameter` leaves darker than a light of almost no size does.
std::ptrdiff_t outer_penumbra(const std::vector<unsigned char>& soft,
                              const std::vector<unsigned char>& hard) {
  std::ptrdiff_t count = 0;
  for (size_t i = 0; i < soft.size(); i += 3) count += soft[i] + 1 < hard[i];
  return count;
}

TEST(TinyTracer, HasUmbraPenumbraAndLight) {
  const auto hard = traced("0.001");
  const auto soft = traced("1.5");
  ASSERT_EQ(soft.size(), 480u * 320u * 3u);
  const std::ptrdiff_t pixels = 480 * 320, penumbra = outer_penumbra(soft, hard);
  EXPECT_GT(penumbra, pixels / 100);
  EXPECT_LT(penumbra, pixels / 4);

  // 255 · 0.08^(1/2.2) = 81: the plane with nothing but ambient light.
  const auto dark = std::ranges::count(soft, 80) + std::ranges::count(soft, 81);
  EXPECT_GT(dark, 3 * pixels / 100);
  const auto lit = std::ranges::count_if(soft, [](int value) { return value > 180; });
  EXPECT_GT(lit, 3 * pixels / 4);
}

/// A ring's area grows between linearly and quadratically with its width.
TEST(TinyTracer, PenumbraGrowsWithTheLight) {
  const auto hard = traced("0.001");
  const auto half = outer_penumbra(traced("0.75"), hard);
  const auto whole = outer_penumbra(traced("1.5"), hard);
  EXPECT_GT(static_cast<double>(whole), 2.0 * static_cast<double>(half));
  EXPECT_LT(static_cast<double>(whole), 4.0 * static_cast<double>(half));
}

}  // namespace
