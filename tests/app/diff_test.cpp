#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <limits>

#include "base/atomic_file.h"
#include "image/exr.h"
#include "image/png.h"
#include "image/srgb.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace penumbra::test {
namespace {

using ::testing::HasSubstr;

float linear(int code) { return static_cast<float>(linear_from_srgb(code / 255.0)); }

// a.png is gray; in b.png pixel 3,4 is 10 codes lighter. a.exr and b.exr are the same in linear
// light, with the red of that pixel as the channel mask.Y too.
class DiffTest : public ::testing::Test {
 protected:
  DiffTest() : a(folder / "a.png"), b(folder / "b.png") {
    Image image = gray(20, 15);
    write_png(a, image);
    write_exr(folder / "a.exr", image);
    for (int c = 0; c < 3; ++c) image.at(3, 4)[c] = linear(138);
    write_png(b, image);
    write_exr(folder / "b.exr", image);
  }

  static Image gray(int width, int height) {
    Image image(width, height, 3);
    for (float& value : image.data) value = linear(128);
    return image;
  }
  static void write_exr(const std::string& file, const Image& image) {
    Image red(image.width, image.height, 1);
    for (std::size_t i = 0; i < red.data.size(); ++i) red.data[i] = image.data[3 * i];
    penumbra::write_exr(file, {{"", {"R", "G", "B"}, &image}, {"mask", {"Y"}, &red}});
  }
  static void write_channel(const std::string& file, const std::string& name, const Image& image) {
    penumbra::write_exr(file, {{"", {name}, &image}});
  }
  void expect_trouble(const std::vector<std::string>& options, const std::string& line) {
    std::vector<std::string> words{"diff"};
    words.insert(words.end(), options.begin(), options.end());
    const long files = folder.count();
    const Outcome outcome = penumbra(words);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.err, "penumbra: " + line + "\n");
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(folder.count(), files);
  }

  TemporaryFolder folder;
  std::string a, b;
};

TEST_F(DiffTest, OfAPictureWithItselfIsZero) {
  for (const std::string& file : {a, folder / "a.exr"}) {
    const Outcome outcome = penumbra({"diff", file, file});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(outcome.out,
              "error 0  (--max-error 0: within)\n"
              "rmse  0\n"
              "psnr  inf dB\n"
              "ssim  1\n"
              "flip  0\n");
  }
}

TEST_F(DiffTest, WithoutLimitsAnyDifferenceIsBeyond) {
  const Outcome outcome = penumbra({"diff", a, b});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("error 0.0392157 at 3,4  (--max-error 0: beyond)\n"));
  // 10/255 at one of 300 pixels.
  EXPECT_THAT(outcome.out, HasSubstr("rmse  0.00226412\n"));
  EXPECT_THAT(outcome.out, HasSubstr("psnr  52.902 dB\n"));
}

TEST_F(DiffTest, CountsOnlyTheLimitsThatAreGiven) {
  const auto status = [&](const std::vector<std::string>& limits) {
    std::vector<std::string> words{"diff", a, b};
    words.insert(words.end(), limits.begin(), limits.end());
    return penumbra(words).status;
  };
  EXPECT_EQ(status({"--max-error", "0.04"}), 0);
  EXPECT_EQ(status({"--max-error", "0.039"}), 1);
  EXPECT_EQ(status({"--max-rmse", "0.0023"}), 0);
  EXPECT_EQ(status({"--max-rmse", "0.0022"}), 1);
  EXPECT_EQ(status({"--min-psnr", "52.9"}), 0);
  EXPECT_EQ(status({"--min-psnr", "53"}), 1);
  EXPECT_EQ(status({"--min-ssim", "0.5"}), 0);
  EXPECT_EQ(status({"--min-ssim", "1"}), 1);
  EXPECT_EQ(status({"--max-flip", "0.5"}), 0);
  EXPECT_EQ(status({"--max-flip", "0"}), 1);
  EXPECT_EQ(status({"--max-error", "0.04", "--max-rmse", "0.0022"}), 1);
  EXPECT_EQ(status({"--max-error", "0.04", "--max-rmse", "0.0023", "--max-flip=0.5"}), 0);
}

TEST_F(DiffTest, QuietSaysNothing) {
  const Outcome outcome = penumbra({"diff", a, b, "--quiet"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(DiffTest, SaysItAsJson) {
  const Outcome outcome = penumbra({"diff", a, b, "--json", "--max-error", "0.1"});
  EXPECT_EQ(outcome.status, 0);
  for (const char* line :
       {"\"error\" : 0.0392", "\"size\" : \n  [\n    20,\n    15\n  ]", "\"within\" : true",
        "\"kind\" : \"display\"", "\"pixels_per_degree\" : 67"})
    EXPECT_THAT(outcome.out, HasSubstr(line));
  EXPECT_THAT(penumbra({"diff", a, a, "--json"}).out, HasSubstr("\"psnr_db\" : null"));
}

TEST_F(DiffTest, FromAfarAChessboardIsGray) {
  Image image = gray(20, 15);
  for (int y = 0; y < 15; ++y)
    for (int x = 0; x < 20; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] += (x + y) % 2 == 0 ? 0.1f : -0.1f;
  const std::string chessboard = folder / "chessboard.png";
  write_png(chessboard, image);
  const auto flip = [&](const char* density) {
    const std::string out = penumbra({"diff", a, chessboard, "--pixels-per-degree", density}).out;
    return std::stod(out.substr(out.find("flip") + 4));
  };
  EXPECT_LT(flip("120"), 0.5 * flip("30"));
}

TEST_F(DiffTest, DrawsAMapOfFlip) {
  const std::string map = folder / "map.png";
  EXPECT_EQ(penumbra({"diff", a, b, "--map", map}).status, 1);
  const Image colors = read_png(map);
  EXPECT_EQ(colors.width, 20);
  EXPECT_EQ(colors.height, 15);
  // Where nothing differs it is magma's black.
  EXPECT_EQ(colors.at(19, 14)[0], 0);
  EXPECT_GT(colors.at(3, 4)[0], 0.002f);
}

TEST_F(DiffTest, DrawsASignedMapOfOneChannel) {
  const std::string map = folder / "map.png";
  const auto color = [&](const std::string& from, const std::string& to) {
    EXPECT_EQ(penumbra({"diff", from, to, "--channel", "mask.Y", "--map", map}).status, 1);
    const Image colors = read_png(map);
    return std::pair(colors.at(3, 4)[0], colors.at(3, 4)[2]);
  };
  const auto [red, blue] = color(folder / "a.exr", folder / "b.exr");
  EXPECT_GT(red, blue);
  const auto [red_back, blue_back] = color(folder / "b.exr", folder / "a.exr");
  EXPECT_LT(red_back, blue_back);
}

TEST_F(DiffTest, ComparesLinearLight) {
  const Outcome outcome = penumbra({"diff", folder / "a.exr", folder / "b.exr", "--max-error=1"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const double error = double{linear(138)} - linear(128);
  EXPECT_NEAR(std::stod(outcome.out.substr(6)), error, 1e-6);
}

TEST_F(DiffTest, TakesTheOnlyChannel) {
  Image depth(12, 12, 1);
  for (float& value : depth.data) value = 2;
  write_channel(folder / "depth.exr", "depth.Z", depth);
  depth.data[5] = 2.5;
  write_channel(folder / "other.exr", "depth.Z", depth);
  const Outcome outcome = penumbra({"diff", folder / "depth.exr", folder / "other.exr"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("error 0.5 at 5,0"));
}

TEST_F(DiffTest, WhatIsNoNumberInBothIsEqual) {
  Image depth(12, 12, 1);
  depth.data[7] = std::numeric_limits<float>::infinity();
  depth.data[8] = std::numeric_limits<float>::quiet_NaN();
  write_channel(folder / "depth.exr", "Z", depth);
  const Outcome outcome = penumbra({"diff", folder / "depth.exr", folder / "depth.exr"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("2 pixels are no number in both and count as equal\n"));
}

TEST_F(DiffTest, RefusesANumberThatIsNoneInOne) {
  Image image = gray(20, 15);
  image.at(7, 2)[1] = std::numeric_limits<float>::quiet_NaN();
  const std::string nan = folder / "nan.exr";
  write_exr(nan, image);
  const std::string words =
      ": pixel 7,2 is not a finite number and not so in the other; mend the picture or compare "
      "another channel";
  expect_trouble({folder / "a.exr", nan}, nan + words);
  expect_trouble({nan, folder / "a.exr"}, nan + words);
}

TEST_F(DiffTest, RefusesOtherSizes) {
  const std::string wide = folder / "wide.png";
  write_png(wide, gray(30, 15));
  expect_trouble({a, wide},
                 wide + ": is 30x15 pixels and " + a + " 20x15; compare pictures of one size");
}

TEST_F(DiffTest, RefusesOneOfEachKind) {
  const std::string exr = folder / "a.exr";
  expect_trouble({a, exr}, exr + ": holds linear light and " + a +
                               " codes for a screen; compare two .png or two .exr files");
}

TEST_F(DiffTest, RefusesWhatItCannotRead) {
  const std::string missing = folder / "missing.png", broken = folder / "broken.png",
                    broken_exr = folder / "broken.exr";
  expect_trouble({a, missing}, missing +
                                   ": cannot be read (No such file or directory); check the "
                                   "name and its rights");
  write_file(broken, read_file(a).substr(0, 60));
  EXPECT_EQ(penumbra({"diff", a, broken}).status, 2);
  write_file(broken_exr, "nonsense");
  EXPECT_EQ(penumbra({"diff", folder / "a.exr", broken_exr}).status, 2);
  expect_trouble({a, folder / "a.jpg"},
                 (folder / "a.jpg") +
                     ": this is no picture that can be read; name a .png or .exr "
                     "file");
}

TEST_F(DiffTest, RefusesTransparentPixels) {
  Image image(20, 15, 4);
  for (float& value : image.data) value = 1;
  image.at(2, 1)[3] = 0.5f;
  const std::string clear = folder / "clear.png";
  write_png(clear, image);
  expect_trouble({a, clear}, clear +
                                 ": pixel 2,1 is transparent; lay the picture over a "
                                 "background first");
}

TEST_F(DiffTest, RefusesUnknownChannels) {
  const std::string exr = folder / "a.exr";
  expect_trouble({exr, exr, "--channel", "mask"},
                 exr +
                     ": there is no channel 'mask'; did you mean mask.Y? There are B, G, R or "
                     "mask.Y");
  expect_trouble({a, b, "--channel", "R"},
                 "--channel: a PNG has no channels with names; leave it out");
  const Image image(4, 4, 2);
  const std::string two = folder / "two.exr";
  penumbra::write_exr(two, {{"normal", {"X", "Y"}, &image}});
  expect_trouble({two, two}, two +
                                 ": there is no R, G and B; choose a channel by --channel: "
                                 "normal.X or normal.Y");
}

TEST_F(DiffTest, RefusesMisuse) {
  expect_trouble({}, "no pictures are named; write penumbra diff A B");
  expect_trouble({a}, "one picture is missing; write penumbra diff A B");
  expect_trouble({a, b, b}, "'" + b + "' is one file too many; see penumbra diff --help");
  expect_trouble({a, b, "--max-eror", "1"},
                 "--max-eror is no option of diff; did you mean --max-error?");
  expect_trouble({a, b, "--max-flip", "2"},
                 "--max-flip: 2 is out of range; give a number from 0 to 1");
  expect_trouble({a, b, "--pixels-per-degree", "0"},
                 "--pixels-per-degree: 0 is out of range; give a number from 1 to 1000");
  expect_trouble({a, b, "--map", folder / "map.exr"},
                 (folder / "map.exr") + ": a map is written as PNG; let it end in .png");
  expect_trouble({a, b, "--map", b}, b + ": this is one of the pictures; name another file for "
                                         "the map");
  const std::string tiny = folder / "tiny.png";
  write_png(tiny, gray(4, 4));
  expect_trouble({tiny, tiny, "--min-ssim", "0.9"},
                 "--min-ssim: these pictures are smaller than its window of 11x11 pixels; leave "
                 "it out");
  EXPECT_THAT(penumbra({"diff", tiny, tiny}).out, HasSubstr("ssim  -\n"));
}

// Trouble is 2 here, also where other commands say 1.
TEST_F(DiffTest, SaysTwoWhereItsMapCannotBeWritten) {
  const std::string map = folder / "no/map.png";
  expect_trouble({a, b, "--map", map}, map + ": the folder " + (folder / "no") +
                                           " does not exist; create it or choose another output");
}

TEST_F(DiffTest, SaysTwoWhereNobodyListens) {
  const Outcome outcome = penumbra({"diff", a, b}, [] { ::close(STDOUT_FILENO); });
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("standard output: cannot be written"));
}

TEST_F(DiffTest, SaysTheSameAtAnyThreadCount) {
  const std::string exr = folder / "a.exr", other = folder / "b.exr";
  EXPECT_EQ(penumbra({"diff", exr, other, "--threads", "1"}).out,
            penumbra({"diff", exr, other, "--threads", "3"}).out);
}

}  // namespace
}  // namespace penumbra::test
