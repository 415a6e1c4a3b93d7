#include "compare/flip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "compare/pictures.h"
#include "compare/slow_flip.h"

namespace penumbra::test {
namespace {

float largest_difference(const Image& a, const Image& b) {
  float largest = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i)
    largest = std::max(largest, std::abs(a.data[i] - b.data[i]));
  return largest;
}

// Floats lose about 1e-7 in a sum of some 20 terms. Where two pictures have the same features, the
// root of half of that is left, 3e-4, in the exponent. Over a picture that averages out.
constexpr float kRounding = 5e-4f;
constexpr double kMeanRounding = 3e-5;

void expect_agreement(const Image& fast, const Image& slow) {
  EXPECT_LT(largest_difference(fast, slow), kRounding);
  EXPECT_NEAR(mean_value(fast), mean_value(slow), kMeanRounding);
}

TEST(Flip, IsZeroForEqualPictures) {
  const Image picture = scenery(90, 70, 1);
  for (const float value : flip_map(picture, picture).data) EXPECT_EQ(value, 0);
}

// A flat picture has no features, so the colour term is left. Black and white differ by
// HyAB = |ΔL*| = 100, and cmax is that of green and blue: by hand, with qc = 0.7, pc = 0.4,
// pt = 0.95,
//   L*a*b* green (87.735, −86.18, 83.18), blue (32.297, 79.19, −107.86), both times L*/100:
//   HyAB = 55.438 + |(−75.61 − 25.57, 72.98 + 34.84)| = 203.29;  cmax = 203.29^0.7 = 41.27
//   100^0.7 = 25.119;  0.95 + (25.119 − 16.509) / (41.27 − 16.509) · 0.05 = 0.9674.
TEST(Flip, OfBlackAndWhiteIsThatOfTheirLightness) {
  const Image map = flip_map(flat(40, 30, 0, 0, 0), flat(40, 30, 1, 1, 1));
  for (const float value : map.data) EXPECT_NEAR(value, 0.9674f, 5e-5);
}

TEST(Flip, OfGreenAndBlueIsOne) {
  const Image map = flip_map(flat(25, 25, 0, 1, 0), flat(25, 25, 0, 0, 1));
  for (const float value : map.data) EXPECT_NEAR(value, 1, 1e-6);
}

TEST(Flip, OfFlatColorsIsTheColorTerm) {
  const double colors[][3] = {{0, 0, 0},       {1, 1, 1},         {1, 0, 0},      {0.5, 0.5, 0.5},
                              {0.2, 0.7, 0.1}, {0.01, 0.02, 0.9}, {0.9, 0.8, 0.1}};
  for (const auto& a : colors)
    for (const auto& b : colors) {
      const auto image = [](const double(&c)[3]) {
        return flat(3, 2, static_cast<float>(c[0]), static_cast<float>(c[1]),
                    static_cast<float>(c[2]));
      };
      // Where colours are equal but for rounding, HyAB's 1e-5 of L* becomes 2e-5.
      EXPECT_NEAR(flip_map(image(a), image(b)).data[0], slow_color_difference(a, b), kRounding);
    }
}

class FlipAtDensity : public ::testing::TestWithParam<float> {};

TEST_P(FlipAtDensity, AgreesWithThePaperWrittenDown) {
  const Image reference = scenery(53, 41, 1), test = scenery(53, 41, 2);
  const Image fast = flip_map(reference, test, GetParam());
  const Image slow = slow_flip(reference, test, GetParam());
  expect_agreement(fast, slow);
  EXPECT_GT(mean_value(slow), 0.05);
}

INSTANTIATE_TEST_SUITE_P(PixelsPerDegree, FlipAtDensity, ::testing::Values(1, 20, 67, 110.5f));

TEST(Flip, AgreesWithThePaperAtSharpEdgesAndPoints) {
  Image reference = flat(60, 40, 0.2f, 0.2f, 0.2f), test = reference;
  for (int y = 0; y < 40; ++y)
    for (int x = 30; x < 60; ++x)
      for (int c = 0; c < 3; ++c) test.at(x, y)[c] = 0.9f;
  for (int c = 0; c < 3; ++c) reference.at(10, 20)[c] = 1;
  expect_agreement(flip_map(reference, test), slow_flip(reference, test, 67));
}

TEST(Flip, ReachesAcrossBandsOfRows) {
  const Image reference = scenery(9, 150, 3), test = scenery(9, 150, 4);
  expect_agreement(flip_map(reference, test), slow_flip(reference, test, 67));
}

TEST(Flip, IsSymmetric) {
  const Image a = scenery(40, 30, 5), b = scenery(40, 30, 6);
  EXPECT_EQ(flip_map(a, b).data, flip_map(b, a).data);
}

TEST(Flip, TakesGrayForThreeEqualChannels) {
  const Image a = noise(30, 20, 1, 1), b = noise(30, 20, 1, 2);
  const auto spread = [](const Image& gray) {
    Image rgb(gray.width, gray.height, 3);
    for (std::size_t i = 0; i < rgb.data.size(); ++i) rgb.data[i] = gray.data[i / 3];
    return rgb;
  };
  EXPECT_EQ(flip_map(a, b).data, flip_map(spread(a), spread(b)).data);
}

TEST(Flip, ClampsAndTakesNanForBlack) {
  Image wild = flat(20, 20, 5, -3, std::numeric_limits<float>::quiet_NaN());
  const Image tame = flat(20, 20, 1, 0, 0);
  EXPECT_EQ(mean_value(flip_map(wild, tame)), 0);
}

TEST(Flip, HasTheSameBitsAtAnyThreadCount) {
  const Image a = scenery(70, 300, 7), b = scenery(70, 300, 8);
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    const Image map = flip_map(a, b);
    return std::pair(map.data, mean_value(map));
  };
  EXPECT_EQ(with(1), with(3));
}

TEST(MeanValue, IsTheMeanOverManyBlocks) {
  Image image(1000, 100, 1);
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = i < 30000 ? 1.0f : 0.0f;
  EXPECT_DOUBLE_EQ(mean_value(image), 0.3);
  EXPECT_EQ(mean_value(Image()), 0);
}

// Narkowicz's curve and the paper's exposures, once more and plainly.
double aces(double x) {
  const double y = 0.6 * x;
  return std::clamp(y * (2.51 * y + 0.03) / (y * (2.43 * y + 0.59) + 0.14), 0.0, 1.0);
}

double ev_of_bright_tone(double luminance) {
  double low = -40, high = 40;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (aces(std::exp2(middle) * luminance) < 0.85 ? low : high) = middle;
  }
  return low;
}

Image developed(const Image& image, double ev) {
  Image out = image;
  for (float& value : out.data) value = static_cast<float>(aces(std::exp2(ev) * value));
  return out;
}

TEST(HdrFlip, IsTheGreatestOverTheExposures) {
  Image reference = scenery(31, 27, 1), test = scenery(31, 27, 2);
  for (float& value : reference.data) value = 30 * value * value * value;
  for (float& value : test.data) value = 30 * value * value * value;
  std::vector<double> luminances;
  for (std::size_t i = 0; i < reference.data.size(); i += 3)
    luminances.push_back(0.2126 * reference.data[i] + 0.7152 * reference.data[i + 1] +
                         0.0722 * reference.data[i + 2]);
  std::sort(luminances.begin(), luminances.end());
  const double first = ev_of_bright_tone(luminances.back());
  const double last = ev_of_bright_tone(luminances[luminances.size() / 2]);
  const int count = static_cast<int>(std::ceil(last - first));
  const HdrFlip flip = hdr_flip(reference, test);
  EXPECT_NEAR(flip.first_ev, first, 1e-5);
  EXPECT_NEAR(flip.last_ev, last, 1e-5);
  ASSERT_EQ(flip.exposures, count);
  ASSERT_GT(count, 3);
  Image greatest(31, 27, 1);
  for (int i = 0; i < count; ++i) {
    const double ev = first + i * (last - first) / (count - 1);
    const Image map = slow_flip(developed(reference, ev), developed(test, ev), 67);
    for (std::size_t k = 0; k < map.data.size(); ++k)
      greatest.data[k] = std::max(greatest.data[k], map.data[k]);
  }
  expect_agreement(flip.map, greatest);
}

TEST(HdrFlip, OfAFlatReferenceTakesTwoEqualExposures) {
  const HdrFlip flip = hdr_flip(flat(20, 10, 4, 4, 4), flat(20, 10, 4, 4, 4));
  EXPECT_EQ(flip.exposures, 2);
  EXPECT_NEAR(flip.first_ev, ev_of_bright_tone(4), 1e-5);
  EXPECT_EQ(flip.first_ev, flip.last_ev);
}

TEST(HdrFlip, OfABlackReferenceLooksAtNoExposure) {
  const HdrFlip flip = hdr_flip(flat(20, 10, 0, 0, 0), flat(20, 10, 1, 1, 1));
  EXPECT_EQ(flip.exposures, 1);
  EXPECT_EQ(flip.first_ev, 0);
  EXPECT_GT(mean_value(flip.map), 0.5);
}

TEST(HdrFlip, EndsWhereTheMedianIsBlack) {
  Image reference = flat(20, 10, 0, 0, 0);
  for (int c = 0; c < 3; ++c) reference.at(3, 3)[c] = 2;
  const HdrFlip flip = hdr_flip(reference, reference);
  EXPECT_NEAR(flip.last_ev - flip.first_ev, 16, 1e-5);
}

TEST(HdrFlip, SeesInTheDarkWhatOneExposureHides) {
  Image reference = flat(60, 60, 3e-4f, 3e-4f, 3e-4f), test = reference;
  for (int c = 0; c < 3; ++c) reference.at(50, 50)[c] = test.at(50, 50)[c] = 100;
  for (int c = 0; c < 3; ++c) test.at(10, 10)[c] = 1e-3f;
  EXPECT_LT(*flip_map(reference, test).at(10, 10), 0.02f);
  EXPECT_GT(*hdr_flip(reference, test).map.at(10, 10), 0.1f);
}

TEST(HdrFlip, TakesTheBrightestAndTheDarkestFloats) {
  const float huge = std::numeric_limits<float>::max();
  const HdrFlip flip = hdr_flip(flat(8, 8, huge, huge, huge), flat(8, 8, -1, 1e-38f, huge));
  for (const float value : flip.map.data) EXPECT_TRUE(value >= 0 && value <= 1) << value;
}

}  // namespace
}  // namespace penumbra::test
