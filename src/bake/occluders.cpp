#include "bake/occluders.h"

#include <algorithm>

#include "bake/closed_mesh.h"
#include "scene/extent.h"
#include "sdf/field.h"
#include "sdf/mesher.h"

namespace penumbra::bake {

struct Occluders::Triangle {
  Vec3 corner[3];
  std::uint32_t instance, triangle, surface;
};

/// A mesh in its place.
struct Occluders::Surface {
  float outer_side = 0;
  Bounds bounds;
};

namespace {

/// What triangles are sorted by.
struct Key {
  Vec3 middle;
  std::uint32_t index;
};

constexpr std::size_t eight = TriangleCluster::size;

/// Splits keys until each run of `size` of them, and each of size / 8 and so on, is close together.
void split(Key* first, Key* last, std::size_t size) {
  const auto count = static_cast<std::size_t>(last - first);
  if (count <= eight) return;
  while (size / eight >= count) size /= eight;
  if (count <= size / eight) return split(first, last, size / eight);
  Bounds bounds;
  for (const Key* k = first; k != last; ++k) bounds.grow(k->middle);
  const Vec3 extent = bounds.size();
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::size_t part = size / eight, parts = (count + part - 1) / part;
  Key* middle = first + parts / 2 * part;
  std::nth_element(first, middle, last, [axis](const Key& a, const Key& b) {
    return a.middle[axis] != b.middle[axis] ? a.middle[axis] < b.middle[axis] : a.index < b.index;
  });
  split(first, middle, size), split(middle, last, size);
}

Bounds bounds_of_cluster(const TriangleCluster& c) {
  Bounds b;
  for (int i = 0; i < c.count; ++i)
    for (const auto& corner : c.corner) b.grow({corner[0][i], corner[1][i], corner[2][i]});
  return b;
}

Bounds bounds_of_node(const BoxCluster& c) {
  Bounds b;
  for (int i = 0; i < c.count; ++i) {
    b.grow({c.lo[0][i], c.lo[1][i], c.lo[2][i]});
    b.grow({c.hi[0][i], c.hi[1][i], c.hi[2][i]});
  }
  return b;
}

template <class Child, class BoundsOf>
std::vector<BoxCluster> parents(const std::vector<Child>& children, const BoundsOf& bounds) {
  std::vector<BoxCluster> nodes((children.size() + eight - 1) / eight);
  for (std::size_t i = 0; i < children.size(); ++i) {
    const Bounds b = bounds(children[i]);
    BoxCluster& node = nodes[i / eight];
    for (int axis = 0; axis < 3; ++axis) {
      node.lo[axis][i % eight] = b.lo[axis];
      node.hi[axis][i % eight] = b.hi[axis];
    }
    ++node.count;
  }
  return nodes;
}

}  // namespace

Occluders::Occluders(const Scene& scene, const sdf::ConversionOptions& conversions)
    : spheres_(scene.spheres),
      roundings_(scene.sdfs.empty() ? 0x1p-21f : 0x1p-18f),
      least_size_(extent_of(scene).diagonal() / 16) {
  add_masks(scene);
  std::vector<Triangle> triangles;
  std::vector<Surface> surfaces;
  std::size_t count = 0;
  for (const Instance& i : scene.instances) count += scene.meshes[i.mesh].triangle_count();
  triangles.reserve(count);
  const auto add = [&](const Mesh& mesh, const Affine& world_from_mesh, std::uint32_t instance) {
    const bool moved = !world_from_mesh.is_identity();
    const auto number = static_cast<std::uint32_t>(surfaces.size());
    Surface& surface = surfaces.emplace_back();
    if (!mask(instance))
      surface.outer_side = static_cast<float>(outer_side(mesh)) *
                           (moved && world_from_mesh.determinant() < 0 ? -1.0f : 1.0f);
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
      Triangle& out = triangles.emplace_back();
      out.instance = instance, out.triangle = t, out.surface = number;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& p = mesh.positions[mesh.indices[std::size_t{3} * t + i]];
        out.corner[i] = moved ? world_from_mesh.point(p) : p;
        surface.bounds.grow(out.corner[i]);
      }
    }
  };
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
    add(scene.meshes[scene.instances[i].mesh], scene.instances[i].world_from_mesh, i);
  if (!scene.sdfs.empty()) {
    sdf::FieldOptions options;
    options.only_distance_fields = true;
    const sdf::Field field(scene, options);
    for (const auto& part :
         sdf::meshes_of_field(field, conversions.bounds, {conversions.voxel_size}))
      add(part.mesh, {}, PrimitiveId::none);
  }
  triangle_count_ = triangles.size();
  arrange(triangles, surfaces);
  bound();
}

void Occluders::add_masks(const Scene& scene) {
  const bool any_holes = std::ranges::any_of(
      scene.materials, [](const Material& m) { return m.alpha_cutoff.has_value(); });
  if (!any_holes) return;
  masks_ = std::make_unique<AlphaMasks>(scene);
  masks_of_.resize(scene.instances.size());
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (const AlphaMask* mask = masks_->find(instance.material))
      masks_of_[i] = std::make_unique<MaskedMesh>(
          MaskedMesh{&scene.meshes[instance.mesh], &scene.materials[instance.material], mask});
  }
}

void Occluders::arrange(const std::vector<Triangle>& triangles,
                        const std::vector<Surface>& surfaces) {
  std::vector<Key> keys;
  keys.reserve(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    // Middles of boxes, which are cheaper than those of areas and bound as well.
    keys.push_back({min(min(t.corner[0], t.corner[1]), t.corner[2]) +
                        max(max(t.corner[0], t.corner[1]), t.corner[2]),
                    i});
  }
  std::size_t size = eight * eight;
  while (size < keys.size()) size *= eight;
  split(keys.data(), keys.data() + keys.size(), size);
  clusters_.resize((keys.size() + eight - 1) / eight);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Triangle& t = triangles[keys[i].index];
    TriangleCluster& cluster = clusters_[i / eight];
    const std::size_t lane = i % eight;
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        cluster.corner[corner][axis][lane] = t.corner[corner][axis];
    cluster.instance[lane] = t.instance, cluster.triangle[lane] = t.triangle;
    const Surface& surface = surfaces[t.surface];
    cluster.outer_side[lane] = surface.outer_side;
    if (surface.outer_side != 0) cluster.closed_surfaces.grow(surface.bounds);
    cluster.masked |= mask(t.instance) != nullptr;
    ++cluster.count;
  }
}

void Occluders::bound() {
  if (clusters_.empty()) return;
  levels_.push_back(parents(clusters_, bounds_of_cluster));
  while (levels_.back().size() > 1) levels_.push_back(parents(levels_.back(), bounds_of_node));
  bounds_ = bounds_of_node(levels_.back().front());
}

}  // namespace penumbra::bake
