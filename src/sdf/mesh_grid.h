// Signed distance to a triangle mesh: a sparse grid, and near the surface the triangles themselves.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "scene/scene.h"
#include "sdf/mesh_distance.h"

namespace penumbra::sdf {

struct DistanceLevels;
class TriangleTree;

struct GridOptions {
  /// Metres, in the mesh's frame; unset = 1/128 of the mesh's longest side.
  std::optional<double> voxel_size{};
  std::size_t most_bytes = std::size_t{1} << 30;
  /// A file that the grid is read from if it fits the mesh and the options, else written to where
  /// that is possible; empty = none.
  std::string cache{};
};

/// Distances in the mesh's own frame, negative inside, in metres. Inside is where the generalized
/// winding number (Jacobson et al. 2013) is above 1/2, of meshes with holes above 0.6: open sheets
/// have two outsides. Where the triangles leave a hole in what is inside, the sign changes without
/// a zero.
///
/// Sampled adaptively (Frisken et al. 2000): cells of h = voxel · 2^l where the distance d is 6 h
/// or more. Below 3 voxels d is the triangles' own, exact up to rounding; from 4 on it is trilinear
/// in its cell less its greatest overestimate there, h² / (4 d) (the second derivatives of a
/// distance sum to 2 / d). So |value| ≤ d everywhere; d − |value| is below 0.92 h and, where the
/// nearest point is not in doubt, below 0.2 h. Beyond 32 times the mesh's size d is that to its
/// bounding ball.
///
/// Immutable; queries are thread-safe, and several threads or processes may share a cache.
class MeshGrid {
 public:
  /// Throws InputError where the grid would take more than most_bytes, and Cancelled.
  explicit MeshGrid(const Mesh& mesh, const GridOptions& options = {});
  ~MeshGrid();
  MeshGrid(MeshGrid&&) noexcept;
  MeshGrid& operator=(MeshGrid&&) noexcept;

  /// +∞ without triangles.
  float distance(const Vec3& p) const;
  /// The unit vector in which the distance grows, from the nearest point of the triangles; on them
  /// their normal. (0, 1, 0) without triangles.
  Vec3 gradient(const Vec3& p) const;
  /// Bounds of distance() within `radius` of `center`.
  DistanceRange range(const Vec3& center, float radius) const;

  /// The unit frame of what is behind it: (p − center) / side. Internal to the room, as the two
  /// after it.
  struct Frame {
    Vec3d center;
    double side;
    float ball_radius;  ///< of the mesh about the origin, in that frame
  };
  Frame frame() const;
  const DistanceLevels& levels() const;
  const TriangleTree& triangles() const;

  double voxel_size() const;
  bool was_cached() const;
  bool is_closed() const;
  std::size_t memory_bytes() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// The voxel size that MeshGrid will take.
double voxel_size_of(const Mesh& mesh, const GridOptions& options);
/// True if options.cache holds a grid of this mesh with this voxel size, whole.
bool is_cached(const Mesh& mesh, const GridOptions& options);

}  // namespace penumbra::sdf
