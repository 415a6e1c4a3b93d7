// All that can throw a shadow, in the order in which shafts and rasterisers look at it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/alpha_mask.h"
#include "geometry/hit.h"
#include "scene/scene.h"
#include "sdf/convert.h"

namespace penumbra::bake {

/// Eight triangles side by side; world frame, metres.
struct TriangleCluster {
  static constexpr int size = 8;
  alignas(32) float corner[3][3][size];  ///< by corner and axis
  std::uint32_t instance[size], triangle[size];
  /// 1 or −1: the triangle is part of a closed surface whose outside is where it winds
  /// counter-clockwise or clockwise; 0: it is not. A point outside of the surface sees of all that
  /// the surface hides from it some triangle from outside (the last on the way to it), so that
  /// those seen from inside need not be drawn.
  alignas(32) float outer_side[size] = {};
  Bounds closed_surfaces;  ///< round all of those that it has parts of
  int count = 0;
  bool masked = false;  ///< any of a material with holes
};

/// Boxes of eight clusters or nodes side by side.
struct BoxCluster {
  alignas(32) float lo[3][TriangleCluster::size], hi[3][TriangleCluster::size];
  int count = 0;
};

/// Triangles and spheres of a scene; distance fields as triangles. Median splits along the longest
/// axis, at multiples of powers of eight, leave an order in which node i of a level has the nodes
/// 8 i … 8 i + 7 of the level below: no pointers, and quickly made. Immutable; thread-safe.
class Occluders {
 public:
  explicit Occluders(const Scene& scene, const sdf::ConversionOptions& conversions = {});

  const std::vector<TriangleCluster>& clusters() const { return clusters_; }
  /// levels()[0][i] holds the boxes of clusters 8 i … 8 i + 7, levels()[k] those of nodes of
  /// levels()[k − 1]; the last level has one node, the root. Empty without triangles.
  const std::vector<std::vector<BoxCluster>>& levels() const { return levels_; }
  const std::vector<Sphere>& spheres() const { return spheres_; }
  /// Null where a material has no holes.
  const MaskedMesh* mask(std::uint32_t instance) const {
    return instance < masks_of_.size() ? masks_of_[instance].get() : nullptr;
  }
  std::size_t triangle_count() const { return triangle_count_; }
  const Bounds& bounds() const { return bounds_; }  ///< of the triangles

  /// What is nearer than this to a plane through p lies on it, metres: World::epsilon_at().
  float epsilon_at(const Vec3& p) const {
    return roundings_ * std::max(max_component(abs(p)), least_size_);
  }

 private:
  struct Triangle;
  struct Surface;

  void add_masks(const Scene& scene);
  void arrange(const std::vector<Triangle>& triangles, const std::vector<Surface>& surfaces);
  void bound();

  std::vector<TriangleCluster> clusters_;
  std::vector<std::vector<BoxCluster>> levels_;
  std::vector<Sphere> spheres_;
  std::unique_ptr<AlphaMasks> masks_;
  std::vector<std::unique_ptr<MaskedMesh>> masks_of_;  ///< per instance
  std::size_t triangle_count_ = 0;
  Bounds bounds_;
  float roundings_, least_size_;
};

}  // namespace penumbra::bake
