#include "image/texture_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "image/mip_level.h"
#include "image/srgb.h"

namespace penumbra {
namespace {

TextureImage image_of(int width, int height, std::uint8_t (*value)(int x, int y, int channel)) {
  TextureImage image{"", width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 4; ++c) image.rgba.push_back(value(x, y, c));
  return image;
}

std::uint8_t ramp(int x, int y, int channel) {
  return static_cast<std::uint8_t>(channel == 0 ? 40 * x : channel == 1 ? 40 * y : 255);
}
std::uint8_t checker(int x, int y, int channel) {
  return static_cast<std::uint8_t>((x + y) % 2 || channel == 3 ? 255 : 0);
}

// Red of the unfiltered linear-encoded texture in 40ths of a code: the texel's column.
double column(const TextureSampler& sampler, const TextureSlot& slot, float u, float v = 0.5f) {
  return sampler.sample(slot, {u, v}, 0).color.x * 255.0 / 40;
}

TEST(TextureSampler, TexelCentresAreExactAndBetweenIsLinear) {
  const TextureImage image = image_of(4, 4, ramp);
  const TextureSampler sampler(image, false);
  const TextureSlot slot{.image = 0, .wrap_s = Wrap::clamp, .wrap_t = Wrap::clamp};
  EXPECT_NEAR(column(sampler, slot, 0.125f), 0, 1e-5);
  EXPECT_NEAR(column(sampler, slot, 0.375f), 1, 1e-5);
  EXPECT_NEAR(column(sampler, slot, 0.5f), 1.5, 1e-5);
  EXPECT_NEAR(sampler.sample(slot, {0.1f, 0.625f}, 0).color.y * 255 / 40, 2, 1e-5);
}

TEST(TextureSampler, WrapModes) {
  const TextureImage image = image_of(4, 1, ramp);
  const TextureSampler sampler(image, false);
  TextureSlot slot{.image = 0};
  EXPECT_NEAR(column(sampler, slot, 1.375f), 1, 1e-4);
  EXPECT_NEAR(column(sampler, slot, -0.125f), 3, 1e-4);
  EXPECT_NEAR(column(sampler, slot, 0), 1.5, 1e-4);  // halfway between the last and the first
  slot.wrap_s = Wrap::clamp;
  EXPECT_NEAR(column(sampler, slot, -5), 0, 1e-4);
  EXPECT_NEAR(column(sampler, slot, 0), 0, 1e-4);
  EXPECT_NEAR(column(sampler, slot, 7), 3, 1e-4);
  slot.wrap_s = Wrap::mirror;
  EXPECT_NEAR(column(sampler, slot, 1.125f), 3, 1e-4);
  EXPECT_NEAR(column(sampler, slot, 1.375f), 2, 1e-4);
  EXPECT_NEAR(column(sampler, slot, -0.375f), 1, 1e-4);
  EXPECT_NEAR(column(sampler, slot, 2.375f), 1, 1e-4);
}

TEST(TextureSampler, NearestKeepsTexels) {
  const TextureImage image = image_of(4, 4, ramp);
  const TextureSampler sampler(image, false);
  const TextureSlot slot{.image = 0, .nearest = true};
  EXPECT_NEAR(column(sampler, slot, 0.49f), 1, 1e-5);
  EXPECT_NEAR(column(sampler, slot, 0.51f), 2, 1e-5);
}

TEST(TextureSampler, AnyCoordinateIsSafe) {
  const TextureImage image = image_of(4, 4, ramp);
  const TextureSampler sampler(image, true);
  for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror})
    for (const bool nearest : {false, true})
      for (const float u : {NAN, INFINITY, -INFINITY, 1e30f, -1e30f, -1e-30f, 3e9f})
        for (const float width : {0.0f, 1e30f, INFINITY, NAN, -1.0f}) {
          const TextureSlot slot{.image = 0, .wrap_s = wrap, .wrap_t = wrap, .nearest = nearest};
          const Rgba texel = sampler.sample(slot, {u, -u}, width);
          EXPECT_TRUE(is_finite(texel.color)) << u << ' ' << width;
          EXPECT_NEAR(texel.alpha, 1, 1e-5);
          EXPECT_NEAR(sample_alpha(image, slot, {u, u}), 1, 1e-5);
        }
}

TEST(TextureSampler, AveragesInLinearLight) {
  const TextureImage image = image_of(16, 16, checker);
  const TextureSampler sampler(image, true);
  EXPECT_EQ(sampler.level_count(), 5);
  for (const float width : {0.125f, 0.3f, 1.0f, 5.0f})
    EXPECT_NEAR(sampler.sample({.image = 0}, {0.3f, 0.7f}, width).color.x, 0.5, 0.004) << width;
}

TEST(TextureSampler, DetailFadesWithoutAStep) {
  const TextureImage image = image_of(16, 16, checker);
  const TextureSampler sampler(image, true);
  const TextureSlot slot{.image = 0};
  float last = sampler.sample(slot, {0.03125f, 0.03125f}, 0).color.x;
  for (float width = 0; width < 1.5f; width += 0.001f) {
    const float now = sampler.sample(slot, {0.03125f, 0.03125f}, width).color.x;
    EXPECT_LT(std::abs(now - last), 0.02f) << width;
    last = now;
  }
}

TEST(TextureSampler, FootprintFollowsTheSlotsScale) {
  const TextureImage image = image_of(16, 16, checker);
  const TextureSampler sampler(image, true);
  const TextureSlot scaled{.image = 0, .scale = {4, 4}};
  EXPECT_NEAR(sampler.sample(scaled, {0.0078125f, 0.0078125f}, 0.0078125f).color.x, 0, 1e-5);
  EXPECT_NEAR(sampler.sample(scaled, {0.0078125f, 0.0078125f}, 0.03125f).color.x, 0.5, 0.004);
}

TEST(Halved, OddSizesKeepTheMean) {
  std::mt19937 random(5);
  TextureImage image{"", 7, 5, std::vector<std::uint8_t>(7 * 5 * 4)};
  for (auto& x : image.rgba) x = static_cast<std::uint8_t>(random());
  const TextureImage half = halved(image, false);
  ASSERT_EQ(half.width, 3);
  ASSERT_EQ(half.height, 2);
  double mean = 0, mean_of_half = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) mean += image.rgba[i] / 35.0;
  for (std::size_t i = 0; i < half.rgba.size(); i += 4) mean_of_half += half.rgba[i] / 6.0;
  EXPECT_NEAR(mean, mean_of_half, 0.5);
}

TEST(Halved, ThinImagesEndAtOneTexel) {
  const TextureImage image = image_of(9, 1, ramp);
  const TextureImage half = halved(image, false);
  EXPECT_EQ(half.width, 4);
  EXPECT_EQ(half.height, 1);
}

TEST(SampleAlpha, IsBilinearAtFullResolution) {
  const TextureImage image =
      image_of(2, 1, [](int x, int, int) { return static_cast<std::uint8_t>(x ? 255 : 0); });
  const TextureSlot slot{.image = 0, .wrap_s = Wrap::clamp};
  EXPECT_NEAR(sample_alpha(image, slot, {0.25f, 0}), 0, 1e-6);
  EXPECT_NEAR(sample_alpha(image, slot, {0.5f, 0}), 0.5, 1e-6);
  EXPECT_NEAR(sample_alpha(image, slot, {0.75f, 0}), 1, 1e-6);
}

// The example of KHR_texture_transform: offset (0, 1), a quarter turn and scale ½ show the lower
// left quadrant of the image; v points down, so that is u < ½, v > ½.
TEST(TransformUv, TheExtensionsExampleShowsTheLowerLeftQuadrant) {
  const TextureSlot slot{
      .image = 0, .offset = {0, 1}, .scale = {0.5f, 0.5f}, .rotation = 1.57079632679f};
  const Vec2 a = transform_uv(slot, {0, 0}), b = transform_uv(slot, {1, 0}),
             c = transform_uv(slot, {0, 1});
  EXPECT_NEAR(a.x, 0, 1e-6);
  EXPECT_NEAR(a.y, 1, 1e-6);
  EXPECT_NEAR(b.x, 0, 1e-6);
  EXPECT_NEAR(b.y, 0.5, 1e-6);
  EXPECT_NEAR(c.x, 0.5, 1e-6);
  EXPECT_NEAR(c.y, 1, 1e-6);
}

TEST(TransformUv, ScaleComesBeforeRotation) {
  const TextureSlot slot{.image = 0, .offset = {1, 2}, .scale = {2, 3}, .rotation = 0.5f};
  const Vec2 at = transform_uv(slot, {0.25f, 0.5f});
  EXPECT_NEAR(at.x, 1 + std::cos(0.5) * 0.5 + std::sin(0.5) * 1.5, 1e-6);
  EXPECT_NEAR(at.y, 2 - std::sin(0.5) * 0.5 + std::cos(0.5) * 1.5, 1e-6);
}

}  // namespace
}  // namespace penumbra
