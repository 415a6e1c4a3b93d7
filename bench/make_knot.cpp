// A rough torus knot of a wanted number of triangles, as a text PLY file: a detailed model that
// anyone can make.
//   make_knot TRIANGLES OUT.ply
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/vec.h"

namespace penumbra::bench {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr int shape = 12;  // rings are this many times as many as a ring's vertices

/// The (2, 3) torus knot, one metre wide or so, upright.
Vec3d curve(double s) {
  const double r = 0.32 + 0.14 * std::cos(3 * turn * s);
  return {r * std::cos(2 * turn * s), 0.16 * std::sin(3 * turn * s), r * std::sin(2 * turn * s)};
}

/// Scales along and around the tube, coarse to fine; periodic in both.
double relief(double s, double t) {
  double height = 0;
  for (int octave = 0; octave < 6; ++octave) {
    const double f = std::pow(2.0, octave);
    height += std::sin(turn * (13 * f * s + f * t)) * std::cos(turn * (9 * f * s - 2 * f * t)) / f;
  }
  return height;
}

Vec3d vertex(double s, double t) {
  const double h = 1e-4;
  const Vec3d along = normalize(curve(s + h) - curve(s - h));
  const Vec3d aside = normalize(cross(along, Vec3d{0, 1, 0}));
  const Vec3d up = cross(aside, along);
  const double radius = 0.085 * (1 + 0.12 * relief(s, t));
  return curve(s) + (aside * std::cos(turn * t) + up * std::sin(turn * t)) * radius;
}

std::string knot(int around, int along) {
  const int vertices = around * along;
  std::string out = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      vertices, 2 * vertices);
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < around; ++j) {
      const Vec3d p = vertex(static_cast<double>(i) / along, static_cast<double>(j) / around);
      out += fmt::format("{:.7g} {:.7g} {:.7g}\n", p.x, p.y, p.z);
    }
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < around; ++j) {
      const int a = i * around + j, b = i * around + (j + 1) % around;
      const int c = (a + around) % vertices, d = (b + around) % vertices;
      out += fmt::format("3 {} {} {}\n3 {} {} {}\n", a, b, d, a, d, c);
    }
  return out;
}

void run(int argc, char** argv) {
  if (argc != 3) throw InputError("a number and a file are needed", "make_knot TRIANGLES OUT.ply");
  const double triangles = std::stod(argv[1]);
  if (!(triangles >= 100 && triangles < 1e8))
    throw InputError("that number of triangles cannot be made", "give 100 to 1e8");
  const int around = static_cast<int>(std::lround(std::sqrt(triangles / (2 * shape))));
  write_file(argv[2], knot(around, static_cast<int>(std::lround(triangles / 2 / around))));
}

}  // namespace
}  // namespace penumbra::bench

int main(int argc, char** argv) {
  try {
    penumbra::bench::run(argc, argv);
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "make_knot: {}\n", e.what());
    return 2;
  }
}
