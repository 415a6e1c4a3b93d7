// What is baked: one side of some triangles, laid out in texels.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/vec.h"

namespace penumbra::bake {

/// The part of a mesh's own texture coordinates that a chart's texels show: texel (i, j) is centred
/// at corner + ((i + ½) / width · size.x, (j + ½) / height · size.y).
struct UvWindow {
  int set = 0;  ///< TEXCOORD_0 or 1
  Vec2 corner, size;
  Vec2 tile;  ///< whole numbers: (0, 0) of the page
};

/// A planar chart: connected coplanar triangles of one instance, seen from one side, and the
/// parallelogram fitted round them (Heckbert and Herf 1997, section 3.2). World frame, metres.
/// Texel (i, j) is centred at base + (i + ½) / width · edge_x + (j + ½) / height · edge_y; texels
/// are kept row by row, j = 0 first.
struct PlanarChart {
  std::uint32_t instance = 0;            ///< into Scene::instances
  std::vector<std::uint32_t> triangles;  ///< of the instance's mesh
  bool back = false;                     ///< the side from which the triangles wind clockwise
  Vec3 base, edge_x, edge_y;
  Vec3 normal;  ///< unit, of the side that is lit
  int width = 0, height = 0;
  std::optional<UvWindow> uv;  ///< laid out by the mesh; none: as seen along the normal

  Vec3 texel(float i, float j) const;  ///< centre of texel (i, j)
};

/// A texel of a chart that is not flat, or a vertex.
struct SurfacePoint {
  Vec3 position;        ///< on the triangle
  Vec3 normal;          ///< unit, of the triangle, on the lit side
  Vec3 shading_normal;  ///< unit; equal to normal on flat shaded meshes
  std::uint32_t instance = 0, triangle = 0;
};

/// A part of a light's points, jittered independently of sets of other numbers.
struct SampleSet {
  float share = 1;  ///< of the points that a receiver has, (0, 1]; at least one is taken
  std::uint32_t number = 0;
};

/// Gives the direct irradiance that reaches surfaces, shadowed, W/m² per channel (linear RGB).
/// Thread-safe.
class Irradiance {
 public:
  virtual ~Irradiance() = default;
  /// At every texel of the chart, also those outside its triangles: out has width · height.
  virtual void of_chart(const PlanarChart& chart, std::span<Vec3> out) const = 0;
  virtual void of_points(std::span<const SurfacePoint> points, std::span<Vec3> out) const = 0;
  /// Of a curved chart: points[k] lies over texels[k] of a plane through it, seen along the plane's
  /// normal; the plane's triangles are those of the whole surface. By default as of_points().
  virtual void of_curved(const PlanarChart& plane, std::span<const SurfacePoint> points,
                         std::span<const std::size_t> texels, std::span<Vec3> out) const;
};

}  // namespace penumbra::bake
