// Texels that two triangles of a texture layout claim.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace penumbra::bake {

/// A triangle laid out in texels.
struct LaidTriangle {
  Vec2 corner[3];
};

struct UvOverlap {
  std::size_t covered = 0;    ///< texels whose centre is within a triangle, all sheets together
  std::size_t contested = 0;  ///< those that are within several
  std::size_t a = 0, b = 0;   ///< the first two, by number, that claim the same texel
};

/// A page on which triangles claim the texels whose centres they hold, clear of their edges by a
/// sixty-fourth of a texel.
class ClaimedTexels {
 public:
  ClaimedTexels(int width, int height);

  /// Counts on; numbers of triangles follow those of earlier calls.
  void add(std::span<const LaidTriangle> triangles);
  const UvOverlap& overlap() const { return overlap_; }

 private:
  int width_, height_;
  std::vector<std::uint32_t> owner_;  ///< 1 + the number of a triangle; 0: none; a bit: several
  std::size_t count_ = 0;
  UvOverlap overlap_;
};

}  // namespace penumbra::bake
