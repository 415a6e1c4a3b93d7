#include "compare/flip_color.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace penumbra {
namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;

// XYZ over white's from linear RGB: sRGB's primaries and D65, IEC 61966-2-1, in exact fractions;
// divided by the sums of the rows, so that white is (1, 1, 1).
constexpr Matrix3 white_xyz_from_rgb() {
  Matrix3 m{{{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
             {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
             {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}}};
  for (auto& row : m) {
    const double white = row[0] + row[1] + row[2];
    for (double& value : row) value /= white;
  }
  return m;
}

constexpr Matrix3 inverse(const Matrix3& m) {
  Matrix3 cofactors{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
      cofactors[j][i] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
    }
  const double determinant =
      m[0][0] * cofactors[0][0] + m[0][1] * cofactors[1][0] + m[0][2] * cofactors[2][0];
  for (auto& row : cofactors)
    for (double& value : row) value /= determinant;
  return cofactors;
}

constexpr Matrix3 kXyzFromRgb = white_xyz_from_rgb(), kRgbFromXyz = inverse(kXyzFromRgb);

Color3 product(const Matrix3& m, const Color3& v) {
  Color3 out;
  for (int i = 0; i < 3; ++i)
    out[i] = static_cast<float>(m[i][0]) * v[0] + static_cast<float>(m[i][1]) * v[1] +
             static_cast<float>(m[i][2]) * v[2];
  return out;
}

// Of a positive number, to 2e-7 of it: a third of the exponent, then two steps of Halley's, which
// leave the cube of 4 % and the cube of that. (Faster than std::cbrt.)
float cube_root(float x) {
  float y = std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) / 3 + 0x2a514067u);
  for (int i = 0; i < 2; ++i) {
    const float cube = y * y * y;
    y *= (cube + 2 * x) / (2 * cube + x);
  }
  return y;
}

// CIELAB's curve.
float lightness(float x) {
  constexpr float delta = 6.0f / 29;
  return x > delta * delta * delta ? cube_root(x) : x / (3 * delta * delta) + 4.0f / 29;
}

Color3 hunt_lab_from_xyz(const Color3& xyz) {
  const float x = lightness(xyz[0]), y = lightness(xyz[1]), z = lightness(xyz[2]);
  const float l = 116 * y - 16;
  return {l, 0.01f * l * 500 * (x - y), 0.01f * l * 200 * (y - z)};
}

// Abasi, Amani Tehran and Fairchild (2020), to the power of qc.
float powered_hyab(const Color3& a, const Color3& b) {
  constexpr float qc = 0.7f;
  const float da = a[1] - b[1], db = a[2] - b[2];
  return std::pow(std::abs(a[0] - b[0]) + std::sqrt(da * da + db * db), qc);
}

float greatest_difference() {
  return powered_hyab(hunt_lab_from_xyz(product(kXyzFromRgb, {0, 1, 0})),
                      hunt_lab_from_xyz(product(kXyzFromRgb, {0, 0, 1})));
}

}  // namespace

Color3 opponent_from_rgb(const Color3& rgb) {
  const Color3 xyz = product(kXyzFromRgb, rgb);
  return {xyz[1], xyz[0] - xyz[1], xyz[1] - xyz[2]};
}

Color3 hunt_lab_from_opponent(const Color3& opponent) {
  const float y = opponent[0];
  Color3 rgb = product(kRgbFromXyz, {y + opponent[1], y, y - opponent[2]});
  for (float& value : rgb) value = std::clamp(value, 0.0f, 1.0f);
  return hunt_lab_from_xyz(product(kXyzFromRgb, rgb));
}

float color_difference(const Color3& a, const Color3& b) {
  constexpr float pc = 0.4f, pt = 0.95f;
  static const float greatest = greatest_difference();
  const float difference = powered_hyab(a, b), knee = pc * greatest;
  if (difference < knee) return pt / knee * difference;
  return std::min(pt + (difference - knee) / (greatest - knee) * (1 - pt), 1.0f);
}

}  // namespace penumbra
