// Which triangles of a mesh share edges.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/world_mesh.h"

namespace penumbra::bake {

/// Triangles are neighbours if they share two vertex positions, whatever their vertices' numbers
/// are. An edge of more than two triangles makes all of them neighbours.
class Adjacency {
 public:
  explicit Adjacency(const WorldMesh& mesh);

  std::span<const std::uint32_t> neighbours(std::uint32_t triangle) const {
    return {list_.data() + first_[triangle], first_[triangle + 1] - first_[triangle]};
  }
  /// True if every edge belongs to two triangles that wind oppositely along it.
  bool is_closed() const { return closed_; }

 private:
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> list_;
  bool closed_ = true;
};

/// The volume that a closed mesh holds, m³; negative if it faces inwards.
double signed_volume(const WorldMesh& mesh);

}  // namespace penumbra::bake
