#include "image/srgb.h"

#include <array>
#include <cmath>

namespace penumbra {
namespace {

std::array<float, 256> make_table(double (*decode)(double)) {
  std::array<float, 256> table{};
  for (int i = 0; i < 256; ++i) table[i] = static_cast<float>(decode(i / 255.0));
  return table;
}

}  // namespace

double linear_from_srgb(double code) {
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

double srgb_from_linear(double linear) {
  return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

const float* srgb_decode_table() {
  static const std::array<float, 256> table = make_table(linear_from_srgb);
  return table.data();
}

const float* unit_decode_table() {
  static const std::array<float, 256> table = make_table([](double code) { return code; });
  return table.data();
}

SrgbEncoder::SrgbEncoder() : first_code_{}, lower_end_{} {
  lower_end_[256] = INFINITY;
  for (int code = 1; code < 256; ++code) {
    float end = static_cast<float>(linear_from_srgb((code - 0.5) / 255));
    while (srgb_from_linear(end) * 255 < code - 0.5) end = std::nextafter(end, 1.0f);
    while (srgb_from_linear(std::nextafter(end, 0.0f)) * 255 >= code - 0.5)
      end = std::nextafter(end, 0.0f);
    lower_end_[code] = end;
  }
  int code = 0;
  for (int bin = 0; bin < kBins; ++bin) {
    while (lower_end_[code + 1] <= static_cast<float>(bin) / kBins) ++code;
    first_code_[bin] = static_cast<std::uint8_t>(code);
  }
}

const SrgbEncoder& srgb_encoder() {
  static const SrgbEncoder encoder;
  return encoder;
}

}  // namespace penumbra
