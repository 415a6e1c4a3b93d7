#include "compare/picture_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "compare/pictures.h"
#include "compare/ssim.h"
#include "image/srgb.h"

namespace penumbra::test {
namespace {

TEST(PictureErrors, OfLinearPicturesByHand) {
  const Image reference = flat(20, 12, 1, 2, 4);
  Image test = reference;
  test.at(7, 5)[1] = 3.5f;
  const PictureErrors errors = picture_errors(reference, test, PictureKind::linear);
  const double rmse = std::sqrt(1.5 * 1.5 / (20 * 12 * 3));
  EXPECT_NEAR(errors.rmse, rmse, 1e-9);
  EXPECT_NEAR(errors.psnr_db, 20 * std::log10(4 / rmse), 1e-9);
  EXPECT_EQ(errors.largest, 1.5);
  EXPECT_EQ(errors.largest_x, 7);
  EXPECT_EQ(errors.largest_y, 5);
}

TEST(PictureErrors, OfDisplayedPicturesAreThoseOfTheirCodes) {
  const auto code = [](int c) { return static_cast<float>(linear_from_srgb(c / 255.0)); };
  const Image reference = flat(16, 16, code(10), code(100), code(200));
  const Image test = flat(16, 16, code(13), code(96), code(200));
  const PictureErrors errors = picture_errors(reference, test, PictureKind::display);
  const double rmse = std::sqrt((3.0 * 3 + 4 * 4) / 3) / 255;
  EXPECT_NEAR(errors.rmse, rmse, 1e-6);
  EXPECT_NEAR(errors.psnr_db, -20 * std::log10(rmse), 1e-3);
  EXPECT_NEAR(errors.largest, 4.0 / 255, 1e-6);
}

TEST(PictureErrors, OfEqualPicturesAreNone) {
  const Image picture = scenery(40, 30, 1);
  for (const PictureKind kind : {PictureKind::display, PictureKind::linear}) {
    const PictureErrors errors = picture_errors(picture, picture, kind);
    EXPECT_EQ(errors.rmse, 0);
    EXPECT_EQ(errors.psnr_db, std::numeric_limits<double>::infinity());
    EXPECT_EQ(errors.largest, 0);
    EXPECT_EQ(errors.ssim, 1);
  }
}

TEST(PictureErrors, OfABlackReferenceHaveThePeakOne) {
  const PictureErrors errors =
      picture_errors(flat(12, 12, 0, 0, 0), flat(12, 12, 0.1f, 0.1f, 0.1f), PictureKind::linear);
  EXPECT_NEAR(errors.psnr_db, 20, 1e-5);
  EXPECT_NEAR(*errors.ssim, 1e-4 / (0.01 + 1e-4), 1e-6);
}

TEST(PictureErrors, AreTheSameAtAnyThreadCount) {
  const Image a = scenery(200, 200, 1), b = scenery(200, 200, 2);
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    const PictureErrors e = picture_errors(a, b, PictureKind::display);
    return std::vector<double>{e.rmse, e.largest, *e.ssim};
  };
  EXPECT_EQ(with(1), with(3));
}

// Wang et al. (2004) written down: every window by itself, in double precision.
double slow_ssim(const Image& a, const Image& b, double range) {
  const auto gray = [](const float* p) { return 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2]; };
  double weights[11][11], total = 0;
  for (int j = 0; j < 11; ++j)
    for (int i = 0; i < 11; ++i)
      total += weights[j][i] = std::exp(-((i - 5) * (i - 5) + (j - 5) * (j - 5)) / (2 * 1.5 * 1.5));
  double sum = 0;
  for (int y = 0; y + 11 <= a.height; ++y)
    for (int x = 0; x + 11 <= a.width; ++x) {
      double ma = 0, mb = 0, va = 0, vb = 0, cov = 0;
      const auto each = [&](auto use) {
        for (int j = 0; j < 11; ++j)
          for (int i = 0; i < 11; ++i)
            use(weights[j][i] / total, gray(a.at(x + i, y + j)), gray(b.at(x + i, y + j)));
      };
      each([&](double w, double p, double q) { ma += w * p, mb += w * q; });
      each([&](double w, double p, double q) {
        va += w * (p - ma) * (p - ma);
        vb += w * (q - mb) * (q - mb);
        cov += w * (p - ma) * (q - mb);
      });
      const double c1 = std::pow(0.01 * range, 2), c2 = std::pow(0.03 * range, 2);
      sum += (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
    }
  return sum / ((a.width - 10) * (a.height - 10));
}

TEST(Ssim, AgreesWithThePaperWrittenDown) {
  for (const auto& [width, height] : {std::pair(47, 33), {11, 11}, {12, 160}}) {
    const Image a = scenery(width, height, 1), b = scenery(width, height, 2);
    for (const double range : {1.0, 0.25})
      EXPECT_NEAR(*mean_ssim(a, b, range), slow_ssim(a, b, range), 1e-5);
  }
}

// (x² + 3 y²) mod 256 against (x y + 7 x) mod 256 of 64 × 48 pixels, by scikit-image 0.19:
// structural_similarity(…, data_range=255, gaussian_weights=True, sigma=1.5,
// use_sample_covariance=False).
TEST(Ssim, AgreesWithScikitImage) {
  Image a(64, 48, 1), b(64, 48, 1);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      *a.at(x, y) = static_cast<float>((x * x + 3 * y * y) % 256);
      *b.at(x, y) = static_cast<float>((x * y + 7 * x) % 256);
    }
  EXPECT_NEAR(*mean_ssim(a, b, 255), -0.010963892, 1e-6);
}

TEST(Ssim, DependsOnTheShareOfTheRangeAlone) {
  Image a = scenery(30, 30, 1), b = scenery(30, 30, 2);
  const double ssim = *mean_ssim(a, b, 1);
  for (const double scale : {1e-30, 1e30}) {
    Image small = a, other = b;
    for (float& value : small.data) value *= static_cast<float>(scale);
    for (float& value : other.data) value *= static_cast<float>(scale);
    EXPECT_NEAR(*mean_ssim(small, other, scale), ssim, 1e-5);
  }
}

TEST(Ssim, IsNoneWhereNoWindowFits) {
  EXPECT_FALSE(mean_ssim(flat(10, 40, 0, 0, 0), flat(10, 40, 0, 0, 0), 1));
  EXPECT_FALSE(mean_ssim(flat(40, 10, 0, 0, 0), flat(40, 10, 0, 0, 0), 1));
}

TEST(FirstNotFinite, IsAPixel) {
  Image image = flat(5, 4, 1, 1, 1);
  EXPECT_FALSE(first_not_finite(image));
  image.at(3, 2)[1] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(first_not_finite(image), 13u);
  image.at(1, 0)[2] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(first_not_finite(image), 1u);
}

}  // namespace
}  // namespace penumbra::test
