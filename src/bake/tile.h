// A rectangle of a chart's texels, worked on as one.
#pragma once

#include "bake/chart.h"
#include "bake/pyramid.h"

namespace penumbra::bake {

/// Texel (i, j) of the tile, 0 ≤ i < width, 0 ≤ j < height, is centred at origin + i step_x +
/// j step_y.
struct Tile {
  Vec3 origin, step_x, step_y;
  Vec3 normal;  ///< unit, of the lit side
  int width = 0, height = 0;
  int first_column = 0, first_row = 0;  ///< in the chart

  Tile(const PlanarChart& chart, int column, int row, int columns, int rows)
      : origin(chart.texel(static_cast<float>(column), static_cast<float>(row))),
        step_x(chart.edge_x / static_cast<float>(chart.width)),
        step_y(chart.edge_y / static_cast<float>(chart.height)),
        normal(chart.normal),
        width(columns),
        height(rows),
        first_column(column),
        first_row(row) {}

  /// Corner of the tile's area: x and y are 0 or 1.
  Vec3 corner(int x, int y) const {
    return origin + step_x * (static_cast<float>(x * width) - 0.5f) +
           step_y * (static_cast<float>(y * height) - 0.5f);
  }
  /// One texel, from its centre: what is projected to x_u = i, y_u = j is in the middle of (i, j).
  Parallelogram unit() const { return {Vec3d(origin), Vec3d(step_x), Vec3d(step_y)}; }
  float height_of(const Vec3& p) const { return dot(normal, p - origin); }
};

}  // namespace penumbra::bake
