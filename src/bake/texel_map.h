// Which point of a chart's triangles each of its texels stands for.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/chart.h"
#include "bake/world_mesh.h"

namespace penumbra::bake {

/// A texel's place on the surface: weights of the triangle's corners.
struct TexelPlace {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::uint32_t triangle = none;  ///< none: no part of the chart is near
  float b1 = 0, b2 = 0;           ///< of corners 1 and 2
  float distance = INFINITY;      ///< in texels, from the texel's centre; 0 inside a triangle

  bool is_inside() const { return distance == 0; }
  bool is_used() const { return triangle != none; }
};

/// For every texel of a chart, row by row, the nearest point of the chart's triangles, seen along
/// its normal. Texels farther than `reach` texels from all of them have none.
///
/// Points of texels outside are kept clear of the triangle's border by a sixty-fourth of a texel,
/// so that none lies on or in a surface that meets the chart there.
///
/// Texels outside whose centre a triangle of `apron` holds stand for that point of it.
std::vector<TexelPlace> map_texels(const PlanarChart& chart, const WorldMesh& mesh, float reach,
                                   std::span<const std::uint32_t> apron = {});

/// Triangles of the list that lie over others in the chart, seen along its normal, so that a texel
/// cannot say which of them it shows: those that take a texel's centre which one before them holds.
std::vector<std::uint32_t> overlapping(const PlanarChart& chart, const WorldMesh& mesh);

/// Chart coordinates: p seen along the normal is base + s edge_x + t edge_y.
class ChartFrame {
 public:
  explicit ChartFrame(const PlanarChart& chart);
  Vec2 coordinates(const Vec3& p) const;  ///< (s, t)
  Vec2 texels(const Vec3& p) const;  ///< (s width, t height): (½, ½) is texel (0, 0)'s centre
  /// Where a vertex of the chart's mesh lies, by its texture coordinates if these lay the chart
  /// out.
  Vec2 texels(const WorldMesh& mesh, std::uint32_t vertex) const;

 private:
  std::optional<UvWindow> uv_;
  Vec3d base_, along_x_, along_y_;
  float width_, height_;
};

}  // namespace penumbra::bake
