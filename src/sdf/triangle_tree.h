// How far the triangles of a mesh are, and how often they wind around a point.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace penumbra::sdf {

/// A binary tree of boxes over triangles. Coordinates should be of the order of 1. Immutable;
/// queries are thread-safe.
class TriangleTree {
 public:
  TriangleTree() = default;
  /// Three indices a triangle. Triangles without area count as the segment or point that they are.
  TriangleTree(std::span<const Vec3> positions, std::span<const std::uint32_t> indices);

  struct Nearest {
    float distance;
    Vec3 point;
    Vec3 normal;  ///< of its triangle, by its winding; not unit, zero without area
  };
  static constexpr std::size_t no_triangle = SIZE_MAX;
  /// The unsigned distance if it is below `most`, else `most`. `hint`: the triangle nearest to a
  /// point not far away, or no_triangle; becomes that of p where it is known.
  float distance(const Vec3& p, float most, std::size_t& hint) const;
  float distance(const Vec3& p, float most) const;
  /// There must be a triangle.
  Nearest nearest(const Vec3& p) const;

  /// The generalized winding number (Jacobson et al. 2013): 1 inside a closed mesh whose triangles
  /// face outwards, 0 outside; between where there are holes. Triangles far from p are taken
  /// together as dipoles (Barill et al. 2018, section 3, first order; β = 2): an error below 0.1.
  float winding(const Vec3& p) const;
  /// By how much the winding number at `to` is greater for the triangles between: how often the way
  /// there passes one from its front to its back, less how often from its back to its front.
  int crossings(const Vec3& from, const Vec3& to) const;

  /// The tree for shaders, eight numbers a box, parents before children: low corner, number of the
  /// next box where this one is skipped; high corner, first triangle or −1. Twelve a triangle: its
  /// corners; behind the first 1 for the last triangle of a leaf, else 0; behind the second the
  /// triangle's number in `indices`; behind the third 0.
  void write_texels(std::vector<float>& boxes, std::vector<float>& triangles) const;

  bool empty() const { return triangles_.empty(); }
  std::size_t memory_bytes() const;

 private:
  struct Triangle {
    Vec3 a, b, c;
  };
  // The second child follows at `next`, the first right behind its parent.
  struct Node {
    Vec3 lo, hi;
    std::uint32_t next = 0;   // inner: the second child; leaf: its first triangle
    std::uint32_t count = 0;  // of a leaf's triangles; 0 = inner
    Vec3 center;              // the mean of the triangles' centroids by area
    float radius = 0;         // all triangles are within this of it
    Vec3 area;                // sum of the vectors of area
  };
  struct Builder;

  static float squared_distance(const Triangle& t, const Vec3& p, Vec3* point);
  static int crossing(const Triangle& t, const Vec3& from, const Vec3& to);
  std::size_t visit_nearest(const Vec3& p, float& best) const;

  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> numbers_;  // of the triangles, as they were given
};

/// True if each edge is passed as often one way as the other: then winding numbers are whole.
/// Vertices at the same place are the same.
bool is_closed(std::span<const Vec3> positions, std::span<const std::uint32_t> indices);

}  // namespace penumbra::sdf
