// The grids behind MeshGrid, made and kept by OpenVDB. Internal to the room.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sdf/triangle_tree.h"

namespace penumbra::sdf {

/// Unsigned and signed distance at any point, in the frame of the grid.
struct DistanceSource {
  const TriangleTree& triangles;
  bool is_closed;
  bool is_inside(float winding) const { return winding > (is_closed ? 0.5f : 0.6f); }
};

/// A distance whose last four bits say the winding number at its place, where that is nearly whole.
inline float with_winding(float d, float winding) {
  const float whole = std::round(winding);
  const bool fits = std::abs(whole) <= 7 && std::abs(winding - whole) < 0.2f;
  const std::uint32_t code = fits ? static_cast<std::uint32_t>(static_cast<int>(whole) + 8) : 0;
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(d) & ~15u) | code);
}
inline std::optional<int> winding_in(float d) {
  const int code = static_cast<int>(std::bit_cast<std::uint32_t>(d) & 15u);
  return code == 0 ? std::nullopt : std::optional(code - 8);
}

/// Cubes of 8³ cells, each with the values at its 9³ corners, in an octree about the origin.
struct DistanceLevels {
  static constexpr int cells = 8, corners = cells + 1, brick_values = corners * corners * corners;

  float voxel = 0;  ///< side of the finest cells
  int levels = 0;   ///< the root cube is cells · voxel · 2^(levels − 1) wide
  /// ≥ 0: number of the first of 8 children, x fastest; < 0: ~brick. Root is 0.
  std::vector<std::int32_t> nodes;
  std::vector<float> values;  ///< brick_values a brick, x fastest

  std::size_t memory_bytes() const {
    return nodes.capacity() * sizeof(nodes[0]) + values.capacity() * sizeof(values[0]);
  }
};

/// A grid takes more than it may.
struct GridTooLarge {};

/// What tells one grid from another.
struct GridKey {
  std::uint64_t checksum;  ///< of the triangles
  double voxel;
};

/// Samples `source`, with_winding, so that cells of side h have |value| ≥ 4 h unless they are the
/// finest; writes the sparse grids to `file` (an OpenVDB file and a checksum behind it) unless that
/// is empty or cannot be written. Throws GridTooLarge, Cancelled.
DistanceLevels build_levels(const DistanceSource& source, float voxel, std::size_t most_bytes,
                            const GridKey& key, const std::string& file);
/// Nothing if the file is not there, damaged, of another version or another key.
std::optional<DistanceLevels> read_levels(const std::string& file, float voxel,
                                          std::size_t most_bytes, const GridKey& key);
/// True if read_levels would find what it needs, by the file's end alone.
bool has_levels(const std::string& file, std::size_t most_bytes, const GridKey& key);

/// How many levels hold a cube of 64 times the unit.
int level_count(float voxel);

}  // namespace penumbra::sdf
