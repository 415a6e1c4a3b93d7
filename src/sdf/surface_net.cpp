#include "sdf/surface_net.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <cmath>

#include "base/cancel.h"
#include "base/parallel.h"
#include "sdf/distance_levels.h"

namespace penumbra::sdf {
namespace {

constexpr int side = 8;  // voxels of a leaf
constexpr std::size_t leaf_values = side * side * side;
// Of a leaf: its values, and what becomes of them.
constexpr std::size_t leaf_bytes = 4 * leaf_values * sizeof(float);

struct Block {
  int x, y, z;  ///< of its first voxel
  int size;     ///< in voxels: side · 2^n
};

class Sampling {
 public:
  Sampling(const DistanceFunction& f, const Bounds& bounds, float voxel, std::size_t most_bytes)
      : f_(f), origin_(bounds.lo), voxel_(voxel), most_bytes_(most_bytes) {
    const float longest = max_component(bounds.size()) / voxel + 1;
    whole_ = side;
    while (static_cast<float>(whole_) < longest) whole_ *= 2;
  }

  openvdb::FloatGrid::Ptr run() {
    auto grid = openvdb::FloatGrid::create(static_cast<float>(whole_) * voxel_);
    std::vector<Block> blocks{{0, 0, 0, whole_}};
    while (!blocks.empty() && blocks[0].size > side) blocks = divided(blocks, *grid);
    fill(blocks, *grid);
    return grid;
  }

 private:
  Vec3 at(float x, float y, float z) const { return origin_ + Vec3(x, y, z) * voxel_; }

  // Those eighths that the surface may pass; the others are known by their sign.
  std::vector<Block> divided(const std::vector<Block>& blocks, openvdb::FloatGrid& grid) {
    throw_if_cancelled();
    if (blocks.size() * leaf_bytes > most_bytes_) throw GridTooLarge{};
    std::vector<Block> parts;
    std::vector<Vec3> middles;
    const int size = blocks[0].size / 2;
    const auto half = 0.5f * static_cast<float>(size - 1);
    for (const Block& b : blocks)
      for (int i = 0; i < 8; ++i) {
        parts.push_back(
            {b.x + size * (i & 1), b.y + size * (i >> 1 & 1), b.z + size * (i >> 2), size});
        const Block& part = parts.back();
        middles.push_back(at(static_cast<float>(part.x) + half, static_cast<float>(part.y) + half,
                             static_cast<float>(part.z) + half));
      }
    const std::vector<float> d = values(middles);
    // Half the diagonal, to the voxels of the neighbours.
    const float reach = std::sqrt(3.0f) * (half + 1.01f) * voxel_;
    std::vector<Block> next;
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (!(std::abs(d[i]) > reach))
        next.push_back(parts[i]);
      else if (d[i] < 0)
        grid.sparseFill({{parts[i].x, parts[i].y, parts[i].z},
                         {parts[i].x + size - 1, parts[i].y + size - 1, parts[i].z + size - 1}},
                        -grid.background(), false);
    return next;
  }

  void fill(const std::vector<Block>& blocks, openvdb::FloatGrid& grid) {
    if (blocks.size() * leaf_bytes > most_bytes_) throw GridTooLarge{};
    std::vector<float*> leaves;
    for (const Block& b : blocks) {
      auto* leaf = grid.tree().touchLeaf({b.x, b.y, b.z});
      leaf->setValuesOn();
      leaves.push_back(leaf->buffer().data());
    }
    parallel_for(blocks.size(), [&](std::size_t i) {
      std::vector<Vec3> points;
      const Block& b = blocks[i];
      for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y)
          for (int z = 0; z < side; ++z)
            points.push_back(at(static_cast<float>(b.x + x), static_cast<float>(b.y + y),
                                static_cast<float>(b.z + z)));
      f_(points, {leaves[i], leaf_values});
    });
  }

  std::vector<float> values(const std::vector<Vec3>& points) const {
    std::vector<float> out(points.size());
    constexpr std::size_t share = 1024;
    parallel_for((points.size() + share - 1) / share, [&](std::size_t i) {
      const std::size_t count = std::min(share, points.size() - i * share);
      f_(std::span(points).subspan(i * share, count), std::span(out).subspan(i * share, count));
    });
    return out;
  }

  const DistanceFunction& f_;
  Vec3 origin_;
  float voxel_;
  std::size_t most_bytes_;
  int whole_;
};

}  // namespace

SurfaceNet surface_net(const DistanceFunction& f, const Bounds& bounds, float voxel,
                       std::size_t most_bytes) {
  openvdb::initialize();
  const openvdb::FloatGrid::Ptr grid = Sampling(f, bounds, voxel, most_bytes).run();
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*grid, points, triangles, quads, 0.0, 0.0);
  SurfaceNet net;
  for (const auto& p : points)  // in voxels
    net.vertices.push_back(bounds.lo + Vec3(p.x(), p.y(), p.z()) * voxel);
  for (const auto& q : quads) net.faces.push_back({q[0], q[1], q[2], q[3]});
  for (const auto& t : triangles) net.faces.push_back({t[0], t[1], t[2], t[2]});
  return net;
}

}  // namespace penumbra::sdf
