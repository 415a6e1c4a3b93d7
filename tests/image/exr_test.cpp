#include "image/exr.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <random>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/parallel.h"
#include "support/temporary_folder.h"

namespace penumbra {
namespace {

using test::TemporaryFolder;

Image noise(int width, int height, int channels) {
  Image image(width, height, channels);
  std::mt19937 random(7);
  for (float& x : image.data) x = std::ldexp(static_cast<float>(random() % 10000), -8);
  return image;
}

TEST(Exr, LayersKeepNamesAndValues) {
  const TemporaryFolder folder;
  const Image color = noise(33, 17, 3), depth = noise(33, 17, 1);
  write_exr(folder / "a.exr", {{"", {"R", "G", "B"}, &color}, {"depth", {"Z"}, &depth}},
            {{"software", "a test"}});
  const ExrFile read = read_exr(folder / "a.exr");
  ASSERT_EQ(read.channels.size(), 4u);
  EXPECT_EQ(read.attributes.at("software"), "a test");
  EXPECT_EQ(read.channels.at("depth.Z").data, depth.data);
  for (int y = 0; y < 17; ++y)
    for (int x = 0; x < 33; ++x) {
      EXPECT_EQ(read.channels.at("R").at(x, y)[0], color.at(x, y)[0]);
      EXPECT_EQ(read.channels.at("B").at(x, y)[0], color.at(x, y)[2]);
    }
}

TEST(Exr, HalvesAreNear) {
  const TemporaryFolder folder;
  const Image color = noise(8, 8, 3);
  write_exr(folder / "a.exr", {{"", {"R", "G", "B"}, &color, true}});
  const ExrFile read = read_exr(folder / "a.exr");
  for (int i = 0; i < 64; ++i)
    EXPECT_NEAR(read.channels.at("G").data[i], color.data[3 * i + 1],
                color.data[3 * i + 1] / 2048 + 1e-7);
}

TEST(Exr, InfinityAndNaNSurvive) {
  const TemporaryFolder folder;
  Image depth(2, 1, 1);
  depth.data = {INFINITY, NAN};
  write_exr(folder / "a.exr", {{"depth", {"Z"}, &depth}});
  const Image read = read_exr(folder / "a.exr").channels.at("depth.Z");
  EXPECT_EQ(read.data[0], INFINITY);
  EXPECT_TRUE(std::isnan(read.data[1]));
}

TEST(Exr, SameBytesAtAnyThreadCount) {
  const TemporaryFolder folder;
  const Image color = noise(200, 200, 3);
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    write_exr(folder / std::to_string(threads), {{"", {"R", "G", "B"}, &color}});
  }
  EXPECT_EQ(read_file(folder / "1"), read_file(folder / "2"));
}

TEST(Exr, FullDiskLeavesNothing) {
  const TemporaryFolder folder;
  const Image color = noise(300, 300, 3);
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, SIG_IGN);
  for (const rlim_t size : {100, 3000, 50000}) {
    const rlimit small{size, old.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    EXPECT_THROW(write_exr(folder / "a.exr", {{"", {"R", "G", "B"}, &color}}), WorkError);
    setrlimit(RLIMIT_FSIZE, &old);
    EXPECT_EQ(folder.count(), 0);
  }
}

TEST(Exr, GarbageIsRefused) {
  const TemporaryFolder folder;
  const Image color = noise(40, 40, 3);
  write_exr(folder / "good.exr", {{"", {"R", "G", "B"}, &color}});
  const std::string good = read_file(folder / "good.exr");
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    std::string bad = good;
    bad[random() % 400] = static_cast<char>(random());
    write_file(folder / "bad.exr", bad);
    try {
      read_exr(folder / "bad.exr");
    } catch (const InputError&) {
    }
  }
  write_file(folder / "cut.exr", good.substr(0, good.size() / 2));
  EXPECT_THROW(read_exr(folder / "cut.exr"), InputError);
  write_file(folder / "text.exr", "hello");
  EXPECT_THROW(read_exr(folder / "text.exr"), InputError);
}

}  // namespace
}  // namespace penumbra
