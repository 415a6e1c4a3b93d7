#include "geometry/cone_tree.h"

#include <algorithm>
#include <map>
#include <set>

#include "geometry/cone_tree_data.h"
#include "geometry/wide_builder.h"

namespace penumbra {
namespace {

Bounds triangle_bounds(const Vec3* p) {
  Bounds b;
  for (int i = 0; i < 3; ++i) b.grow(p[i]);
  return b;
}

void triangle_corners(const Mesh& mesh, std::uint32_t triangle, const Affine& to, Vec3* out) {
  const bool moved = !to.is_identity();
  for (int i = 0; i < 3; ++i) {
    const Vec3& p = mesh.positions[mesh.indices[std::size_t{3} * triangle + i]];
    out[i] = moved ? to.point(p) : p;
  }
}

class Builder {
 public:
  Builder(ConeTree::Data& data, std::size_t most_copied)
      : data_(data), scene_(*data.scene), most_copied_(most_copied) {}

  void build() {
    count_instanced();
    for (const Light& light : scene_.lights)
      if (light.type == LightType::mesh)
        emissive_.insert(static_cast<std::uint32_t>(light.instance));
    for (std::uint32_t i = 0; i < scene_.instances.size(); ++i) add_instance(i);
    for (std::uint32_t i = 0; i < scene_.spheres.size(); ++i) {
      const Sphere& s = scene_.spheres[i];
      const Vec3 r(s.radius);
      primitives_.push_back({{s.center - r, s.center + r}, ChildKind::spheres, i});
    }
    data_.ranges.push_back({next_id_, PrimitiveNone});
    const PackLeaf pack = [this](ChildKind kind, const std::uint32_t* indices, int count) {
      return pack_leaf(kind, indices, count);
    };
    data_.root = build_wide_tree(primitives_, data_.nodes, pack);
    for (const BuildPrimitive& p : primitives_) data_.bounds.grow(p.bounds);
    data_.nodes.shrink_to_fit(), data_.triangles.shrink_to_fit();
  }

 private:
  static constexpr std::uint32_t PrimitiveNone = 0xffffffffu;
  void count_instanced() {
    for (const Instance& instance : scene_.instances)
      if (!instance.world_from_mesh.is_identity())
        instanced_triangles_ += scene_.meshes[instance.mesh].triangle_count();
  }

  void add_instance(std::uint32_t index) {
    const Instance& instance = scene_.instances[index];
    if (data_.masks.find(instance.material)) return add_cut_outs(index);
    if (emissive_.contains(index)) return add_emissive(index);
    // A similarity keeps circular cones circular; any other map is applied to the vertices.
    if (instanced_triangles_ > most_copied_ && !instance.world_from_mesh.is_identity() &&
        is_similarity(instance.world_from_mesh))
      return add_placement(index);
    const Mesh& mesh = scene_.meshes[instance.mesh];
    data_.ranges.push_back({next_id_, index});
    primitives_.reserve(primitives_.size() + mesh.triangle_count());
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
      Vec3 p[3];
      triangle_corners(mesh, t, instance.world_from_mesh, p);
      primitives_.push_back({triangle_bounds(p), ChildKind::triangles, next_id_++});
    }
  }

  void add_cut_outs(std::uint32_t index) {
    const Instance& instance = scene_.instances[index];
    const Mesh& mesh = scene_.meshes[instance.mesh];
    const auto scale =
        static_cast<float>(std::cbrt(std::abs(instance.world_from_mesh.determinant())));
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
      CutOut cut{{}, index, t, scale};
      triangle_corners(mesh, t, instance.world_from_mesh, cut.position);
      primitives_.push_back({triangle_bounds(cut.position), ChildKind::cut_out,
                             static_cast<std::uint32_t>(data_.cut_outs.size())});
      data_.cut_outs.push_back(cut);
    }
  }

  void add_placement(std::uint32_t index) {
    const Instance& instance = scene_.instances[index];
    const Affine& m = instance.world_from_mesh;
    const auto [known, is_new] = subtrees_.try_emplace(instance.mesh);
    if (is_new) known->second = subtree(instance.mesh, {});
    place({known->second, index, inverse(m), static_cast<float>(1 / length(m.x))});
  }

  /// A subtree of its own, which queries to its own light pass over as a whole.
  void add_emissive(std::uint32_t index) {
    const Instance& instance = scene_.instances[index];
    place({subtree(instance.mesh, instance.world_from_mesh), index, {}, 1});
  }

  void place(const Placement& placement) {
    if (placement.root.kind() == ChildKind::none) return;
    primitives_.push_back({bounds_of(scene_, scene_.instances[placement.instance]),
                           ChildKind::placement,
                           static_cast<std::uint32_t>(data_.placements.size())});
    data_.placements.push_back(placement);
  }

  /// Of a mesh, moved by `to`.
  Child subtree(std::uint32_t mesh_index, const Affine& to) {
    const Mesh& mesh = scene_.meshes[mesh_index];
    std::vector<BuildPrimitive> primitives;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
      Vec3 p[3];
      triangle_corners(mesh, t, to, p);
      primitives.push_back({triangle_bounds(p), ChildKind::triangles, t});
    }
    const PackLeaf pack = [&](ChildKind, const std::uint32_t* ids, int count) {
      return pack_triangles(ids, count,
                            [&](std::uint32_t id, Vec3* p) { triangle_corners(mesh, id, to, p); });
    };
    return build_wide_tree(primitives, data_.nodes, pack);
  }

  Child pack_leaf(ChildKind kind, const std::uint32_t* indices, int count) {
    if (kind == ChildKind::spheres) return pack_spheres(indices, count);
    if (kind != ChildKind::triangles) return Child::of(kind, indices[0]);
    return pack_triangles(indices, count, [this](std::uint32_t id, Vec3* p) {
      const auto after = std::upper_bound(
          data_.ranges.begin(), data_.ranges.end(), id,
          [](std::uint32_t value, const TriangleRange& r) { return value < r.first; });
      const Instance& instance = scene_.instances[std::prev(after)->instance];
      triangle_corners(scene_.meshes[instance.mesh], id - std::prev(after)->first,
                       instance.world_from_mesh, p);
    });
  }

  template <class Corners>
  Child pack_triangles(const std::uint32_t* ids, int count, const Corners& corners) {
    TriangleLeaf leaf;
    for (int lane = 0; lane < tree_width; ++lane) {
      Vec3 p[3];
      leaf.id[lane] = ids[lane < count ? lane : 0];
      corners(leaf.id[lane], p);
      for (int v = 0; v < 3; ++v)
        for (int axis = 0; axis < 3; ++axis) leaf.position[v][axis][lane] = p[v][axis];
    }
    data_.triangles.push_back(leaf);
    return Child::of(ChildKind::triangles, data_.triangles.size() - 1);
  }

  Child pack_spheres(const std::uint32_t* indices, int count) {
    SphereLeaf leaf;
    for (int lane = 0; lane < tree_width; ++lane) {
      const Sphere& s = scene_.spheres[indices[lane < count ? lane : 0]];
      for (int axis = 0; axis < 3; ++axis) leaf.center[axis][lane] = s.center[axis];
      leaf.radius[lane] = s.radius;
      leaf.object[lane] = s.object;
    }
    data_.spheres.push_back(leaf);
    return Child::of(ChildKind::spheres, data_.spheres.size() - 1);
  }

  ConeTree::Data& data_;
  const Scene& scene_;
  std::vector<BuildPrimitive> primitives_;
  std::map<std::uint32_t, Child> subtrees_;
  std::set<std::uint32_t> emissive_;  ///< instances that are lights
  std::uint32_t next_id_ = 0;
  std::size_t instanced_triangles_ = 0, most_copied_;
};

template <class Vector>
std::size_t bytes(const Vector& v) {
  return v.capacity() * sizeof(typename Vector::value_type);
}

}  // namespace

std::uint32_t ConeTree::Data::instance_of(std::uint32_t id) const {
  const auto after =
      std::upper_bound(ranges.begin(), ranges.end(), id,
                       [](std::uint32_t v, const TriangleRange& r) { return v < r.first; });
  return std::prev(after)->instance;
}

ConeTree::ConeTree(const Scene& scene, std::size_t most_copied_triangles)
    : data_(std::make_unique<Data>(scene)) {
  Builder(*data_, most_copied_triangles).build();
}

ConeTree::~ConeTree() = default;

std::size_t ConeTree::memory_bytes() const {
  return bytes(data_->nodes) + bytes(data_->triangles) + bytes(data_->spheres) +
         bytes(data_->placements) + bytes(data_->cut_outs) + bytes(data_->ranges);
}

SearchLimit SearchLimit::exact() {
  SearchLimit limit;
  for (int i = 0; i < size; ++i)
    limit.fraction[static_cast<std::size_t>(i)] = static_cast<float>(i + 1) / size;
  return limit;
}

}  // namespace penumbra
