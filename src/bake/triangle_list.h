// Triangles on their way from the occluders to a raster.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bake/clip.h"
#include "base/vec.h"

namespace penumbra::bake {

/// Corners coordinate by coordinate, world frame; whole vectors of eight can be read and written
/// past the last.
struct TriangleList {
  static constexpr std::size_t slack = 16;
  std::array<std::array<std::vector<float>, 3>, 3> corner;  ///< by corner and axis
  std::size_t count = 0;

  void clear() { count = 0; }
  void reserve(std::size_t more) {
    const std::size_t size = count + more + slack;
    if (corner[0][0].size() >= size) return;
    for (auto& axes : corner)
      for (auto& values : axes) values.resize(size * 2);
  }
  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    reserve(1);
    const Vec3 corners[] = {a, b, c};
    for (int i = 0; i < 3; ++i)
      for (int axis = 0; axis < 3; ++axis) corner[i][axis][count] = corners[i][axis];
    ++count;
  }
  Vec3 at(std::size_t triangle, int i) const {
    return {corner[i][0][triangle], corner[i][1][triangle], corner[i][2][triangle]};
  }
};

/// A triangle of a material with holes.
struct MaskedTriangle {
  Vec3 corner[3];
  std::uint32_t instance, triangle;
};

}  // namespace penumbra::bake
