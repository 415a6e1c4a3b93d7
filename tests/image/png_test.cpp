#include "image/png.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <random>

#include "base/atomic_file.h"
#include "base/error.h"
#include "image/srgb.h"
#include "support/temporary_folder.h"

namespace penumbra {
namespace {

using test::TemporaryFolder;

Image noise(int width, int height, int channels) {
  Image image(width, height, channels);
  std::mt19937 random(7);
  for (float& x : image.data) x = static_cast<float>(random() % 10000) / 9999;
  return image;
}

TEST(Png, RoundTripOfColourAndAlpha) {
  const TemporaryFolder folder;
  const Image image = noise(37, 11, 4);
  write_png(folder / "a.png", image);
  const Image read = read_png(folder / "a.png");
  ASSERT_EQ(read.width, 37);
  ASSERT_EQ(read.height, 11);
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    if (i % 4 == 3)
      EXPECT_NEAR(read.data[i], image.data[i], 0.5 / 255 + 1e-6);
    else
      EXPECT_EQ(srgb_encoder()(read.data[i]), srgb_encoder()(image.data[i]));
  }
}

TEST(Png, GrayAndRgb) {
  const TemporaryFolder folder;
  for (const int channels : {1, 3}) {
    const Image image = noise(5, 3, channels);
    write_png(folder / "a.png", image);
    const Image read = read_png(folder / "a.png");
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(srgb_encoder()(read.at(4, 2)[c]), srgb_encoder()(image.at(4, 2)[c % channels]));
    EXPECT_EQ(read.at(4, 2)[3], 1);
  }
}

TEST(Png, ExposureCountsInStops) {
  const TemporaryFolder folder;
  Image image(1, 1, 3);
  image.data = {0.1f, 0.2f, NAN};
  write_png(folder / "a.png", image, 1);
  const Image read = read_png(folder / "a.png");
  EXPECT_NEAR(read.data[0], 0.2f, 0.003);
  EXPECT_NEAR(read.data[1], 0.4f, 0.004);
  EXPECT_EQ(read.data[2], 0);
}

TEST(Png, MissingFolderIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_png(folder / "no/a.png", Image(1, 1, 3)), WorkError);
}

TEST(Png, FullDiskLeavesNothing) {
  const TemporaryFolder folder;
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{20000, old.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(write_png(folder / "a.png", noise(200, 200, 3)), WorkError);
  setrlimit(RLIMIT_FSIZE, &old);
  EXPECT_EQ(folder.count(), 0);
}

TEST(Png, GarbageIsRefused) {
  const TemporaryFolder folder;
  write_png(folder / "good.png", noise(50, 50, 3));
  const std::string good = read_file(folder / "good.png");
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    std::string bad = good;
    for (int k = 0; k < 3; ++k) bad[random() % bad.size()] = static_cast<char>(random());
    if (i % 2) bad.resize(random() % bad.size());
    write_file(folder / "bad.png", bad);
    try {
      read_png(folder / "bad.png");
    } catch (const InputError&) {
    }
  }
  write_file(folder / "cut.png", good.substr(0, good.size() / 2));
  EXPECT_THROW(read_png(folder / "cut.png"), InputError);
  EXPECT_THROW(read_png(folder / "none.png"), InputError);
}

TEST(Png, SameBytesEveryTime) {
  const TemporaryFolder folder;
  write_png(folder / "a.png", noise(64, 64, 3));
  write_png(folder / "b.png", noise(64, 64, 3));
  EXPECT_EQ(read_file(folder / "a.png"), read_file(folder / "b.png"));
}

}  // namespace
}  // namespace penumbra
