#include "sdf/glsl/mesh_texels.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "sdf/distance_levels.h"
#include "sdf/glsl/numbers.h"
#include "sdf/triangle_tree.h"

namespace penumbra::sdf {
namespace {

constexpr int corners = DistanceLevels::corners, brick_values = DistanceLevels::brick_values;
/// Nearer to the surface the shader asks for a corner's winding number: less than four voxels for
/// the mean of a cell's corners, which are up to a diagonal apart.
constexpr float asked_within = 6;

// pnb_winding_in undoes it.
float with_code(float d, float winding) {
  const float code = std::clamp(std::round((winding + 1) * 16), 0.0f, 63.0f);
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(d) & ~63u) |
                              static_cast<std::uint32_t>(code));
}

/// The finest bricks and where they begin, in voxels.
struct FineBrick {
  std::size_t number;
  Vec3 low;
};

std::vector<FineBrick> fine_bricks(const DistanceLevels& levels) {
  struct Cube {
    std::int32_t node;
    int level;
    Vec3 low;
  };
  const auto half = static_cast<float>(DistanceLevels::cells / 2 << (levels.levels - 1));
  std::vector<Cube> cubes{{0, levels.levels - 1, Vec3(-half)}};
  std::vector<FineBrick> bricks;
  while (!cubes.empty()) {
    const Cube cube = cubes.back();
    cubes.pop_back();
    const std::int32_t first = levels.nodes[static_cast<std::size_t>(cube.node)];
    if (first < 0 && cube.level == 0)
      bricks.push_back({static_cast<std::size_t>(~first), cube.low});
    if (first < 0) continue;
    const auto side = static_cast<float>(DistanceLevels::cells << (cube.level - 1));
    for (std::int32_t i = 0; i < 8; ++i)
      cubes.push_back({first + i, cube.level - 1,
                       cube.low + Vec3(static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1),
                                       static_cast<float>(i >> 2)) *
                                      side});
  }
  return bricks;
}

void add_windings(const DistanceLevels& levels, const TriangleTree& triangles,
                  const FineBrick& brick, std::vector<float>& values) {
  const std::size_t first = brick.number * brick_values;
  for (int i = 0; i < brick_values; ++i) {
    const float d = levels.values[first + static_cast<std::size_t>(i)];
    float winding = d < 0 ? 1.0f : 0.0f;
    if (const auto whole = winding_in(d)) {
      winding = static_cast<float>(*whole);
    } else if (std::abs(d) < asked_within * levels.voxel) {
      const int x = i % corners, y = i / corners % corners, z = i / (corners * corners);
      const Vec3 corner(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
      winding = triangles.winding((brick.low + corner) * levels.voxel);
    }
    values[first + static_cast<std::size_t>(i)] = with_code(d, winding);
  }
}

std::vector<float> values_of(const DistanceLevels& levels, const TriangleTree& triangles) {
  std::vector<float> values(levels.values.size());
  std::ranges::transform(levels.values, values.begin(),
                         [](float d) { return with_code(d, d < 0 ? 1.0f : 0.0f); });
  const std::vector<FineBrick> bricks = fine_bricks(levels);
  parallel_for(bricks.size(),
               [&](std::size_t i) { add_windings(levels, triangles, bricks[i], values); });
  return values;
}

/// Nodes about the middle, so that a shader need not come down from the root: most of what it asks
/// for is near the mesh, and the root is 64 times as wide.
struct Table {
  int depth, side;
  std::vector<float> pairs;  ///< node, bits of its cells' numbers
};

Table table_of(const DistanceLevels& levels) {
  const int deepest = std::min(levels.levels - 1, 9);
  Table table{deepest < 6 ? 0 : deepest, deepest < 6 ? 1 : 1 << (deepest - 5), {}};
  const int first = ((1 << table.depth) - table.side) / 2;
  for (int i = 0; i < table.side * table.side * table.side; ++i) {
    const int at[3] = {first + i % table.side, first + i / table.side % table.side,
                       first + i / (table.side * table.side)};
    std::int32_t node = levels.nodes[0];
    int step = 0;
    while (node >= 0 && step < table.depth) {
      const int bit = table.depth - ++step;
      const int octant = (at[0] >> bit & 1) | (at[1] >> bit & 1) << 1 | (at[2] >> bit & 1) << 2;
      node = levels.nodes[static_cast<std::size_t>(node + octant)];
    }
    table.pairs.push_back(static_cast<float>(node));
    table.pairs.push_back(static_cast<float>(levels.levels + 2 - step));
  }
  return table;
}

}  // namespace

int MeshTexels::append(const std::vector<float>& numbers) {
  const std::size_t first = texels_.size() / 4;
  texels_.insert(texels_.end(), numbers.begin(), numbers.end());
  texels_.resize((texels_.size() + 3) / 4 * 4);
  return static_cast<int>(first);
}

std::string MeshTexels::add(const MeshGrid& grid) {
  std::string& text = written_[&grid];
  if (!text.empty()) return text;
  const DistanceLevels& levels = grid.levels();
  std::vector<float> boxes, triangles;
  grid.triangles().write_texels(boxes, triangles);
  const std::size_t box_count = boxes.size() / 8;
  const Table table = table_of(levels);
  const int nodes_at = append({levels.nodes.begin(), levels.nodes.end()});
  const int values_at = append(values_of(levels, grid.triangles()));
  const int table_at = append(table.pairs);
  const int boxes_at = append(boxes), triangles_at = append(triangles);
  text = fmt::format("pnb_Grid({}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {})", nodes_at,
                     values_at, table_at, table.depth, table.side, boxes_at, box_count,
                     triangles_at, levels.levels, number(levels.voxel),
                     number(grid.frame().ball_radius), grid.is_closed() ? "0.5" : "0.6");
  return text;
}

}  // namespace penumbra::sdf
