#include "picture_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/nearest_name.h"
#include "image/exr.h"
#include "image/png.h"
#include "outputs.h"
#include "values.h"

namespace penumbra::app {
namespace {

PictureFile read_png_picture(const std::string& file) {
  const Image rgba = read_png(file);
  PictureFile picture{file, Image(rgba.width, rgba.height, 3), PictureKind::display};
  for (std::size_t i = 0; i < rgba.data.size() / 4; ++i) {
    if (rgba.data[4 * i + 3] < 1)
      throw InputError({file},
                       fmt::format("pixel {},{} is transparent", i % rgba.width, i / rgba.width),
                       "lay the picture over a background first");
    for (int c = 0; c < 3; ++c) picture.image.data[3 * i + c] = rgba.data[4 * i + c];
  }
  return picture;
}

Image joined(const std::array<const Image*, 3>& channels) {
  Image image(channels[0]->width, channels[0]->height, 3);
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = channels[i % 3]->data[i / 3];
  return image;
}

std::vector<std::string_view> names_of(const ExrFile& exr) {
  std::vector<std::string_view> names;
  names.reserve(exr.channels.size());
  for (const auto& [name, image] : exr.channels) names.push_back(name);
  return names;
}

Image chosen_channels(const std::string& file, const ExrFile& exr, const std::string& channel) {
  const auto find = [&](const std::string& name) {
    const auto found = exr.channels.find(name);
    return found == exr.channels.end() ? nullptr : &found->second;
  };
  const std::vector<std::string_view> names = names_of(exr);
  if (!channel.empty()) {
    if (const Image* image = find(channel)) return *image;
    throw InputError(
        {file}, fmt::format("there is no channel '{}'", channel),
        fmt::format("did you mean {}? There are {}", nearest_name(channel, names), listed(names)));
  }
  const std::array<const Image*, 3> rgb{find("R"), find("G"), find("B")};
  if (rgb[0] && rgb[1] && rgb[2]) return joined(rgb);
  if (exr.channels.size() == 1) return exr.channels.begin()->second;
  throw InputError({file}, "there is no R, G and B",
                   "choose a channel by --channel: " + listed(names));
}

std::string pixel_name(const Image& image, std::size_t value) {
  const std::size_t pixel = value / image.channels;
  return fmt::format("{},{}", pixel % image.width, pixel / image.width);
}

bool are_the_same_no_number(float a, float b) {
  return (std::isnan(a) && std::isnan(b)) || (std::isinf(a) && a == b);
}

void check_finite(const PictureFile& picture, std::size_t value) {
  if (!std::isfinite(picture.image.data[value]))
    throw InputError({picture.file},
                     fmt::format("pixel {} is not a finite number and not so in the other",
                                 pixel_name(picture.image, value)),
                     "mend the picture or compare another channel");
}

const char* described(PictureKind kind) {
  return kind == PictureKind::display ? "codes for a screen" : "linear light";
}

}  // namespace

PictureFile read_picture(const std::string& file, const std::string& channel) {
  if (has_extension(file, ".exr"))
    return {file, chosen_channels(file, read_exr(file), channel), PictureKind::linear};
  if (!has_extension(file, ".png"))
    throw InputError({file}, "this is no picture that can be read", "name a .png or .exr file");
  if (!channel.empty())
    throw InputError("--channel: a PNG has no channels with names", "leave it out");
  return read_png_picture(file);
}

std::size_t make_comparable(PictureFile& reference, PictureFile& test) {
  Image &a = reference.image, &b = test.image;
  if (reference.kind != test.kind)
    throw InputError({test.file},
                     fmt::format("holds {} and {} {}", described(test.kind), reference.file,
                                 described(reference.kind)),
                     "compare two .png or two .exr files");
  if (a.width != b.width || a.height != b.height)
    throw InputError({test.file},
                     fmt::format("is {}x{} pixels and {} {}x{}", b.width, b.height, reference.file,
                                 a.width, a.height),
                     "compare pictures of one size");
  if (a.channels != b.channels)
    throw InputError({test.file},
                     fmt::format("has {} and {} {}", b.channels == 3 ? "colour" : "one channel",
                                 reference.file, a.channels == 3 ? "colour" : "one channel"),
                     "choose a channel of both by --channel");
  std::size_t pixels = 0, last = a.data.size();
  for (std::size_t i = 0; i < a.data.size(); ++i) {
    if (!are_the_same_no_number(a.data[i], b.data[i])) {
      check_finite(reference, i);
      check_finite(test, i);
      continue;
    }
    a.data[i] = b.data[i] = 0;
    if (i / a.channels != last) ++pixels;
    last = i / a.channels;
  }
  return pixels;
}

}  // namespace penumbra::app
