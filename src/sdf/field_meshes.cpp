// A mesh for each object and material of a field.
#include <algorithm>
#include <map>
#include <unordered_map>

#include "base/error.h"
#include "base/parallel.h"
#include "scene/finish.h"
#include "sdf/field.h"
#include "sdf/mesher.h"

namespace penumbra::sdf {
namespace {

using Owner = Field::Owner;

Bounds box_to_keep(const Field& field, const std::optional<Bounds>& clip) {
  if (clip) return *clip;
  if (!field.is_bounded())
    throw InputError("the scene's distance field has no end, and this method needs triangles of it",
                     "give the box to keep by --bounds x0,y0,z0,x1,y1,z1");
  Bounds box = field.bounds();
  const Vec3 margin(1e-3f * box.diagonal());
  box.lo = box.lo - margin, box.hi = box.hi + margin;
  return box;
}

std::uint32_t heaviest_material(const Field& field, const Vec3& p) {
  const SurfaceAt surface = field.surface(p);
  return std::ranges::max_element(surface.parts, {}, &SurfaceAt::Part::weight)->material;
}

std::vector<Owner> owners_of_triangles(const Field& field, const Mesh& mesh) {
  std::vector<Vec3> middles(mesh.triangle_count());
  for (std::size_t i = 0; i < mesh.indices.size(); ++i)
    middles[i / 3] += mesh.positions[mesh.indices[i]] / 3.0f;
  std::vector<Owner> owners(middles.size());
  constexpr std::size_t share = 256;
  parallel_for((owners.size() + share - 1) / share, [&](std::size_t k) {
    const std::size_t begin = k * share, count = std::min(share, owners.size() - begin);
    field.owners(std::span(middles).subspan(begin, count), std::span(owners).subspan(begin, count));
    for (std::size_t i = begin; i < begin + count; ++i)
      if (owners[i].blended) owners[i].material = heaviest_material(field, middles[i]);
  });
  return owners;
}

/// A part of a mesh, with the vertices that it uses.
class Part {
 public:
  explicit Part(const Mesh& whole) : whole_(whole) {}

  void add(std::size_t triangle) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = whole_.indices[3 * triangle + k];
      const auto next = static_cast<std::uint32_t>(mesh_.positions.size());
      const auto [place, is_new] = numbers_.try_emplace(v, next);
      if (is_new) mesh_.positions.push_back(whole_.positions[v]);
      mesh_.indices.push_back(place->second);
    }
  }
  Mesh take() { return std::move(mesh_); }

 private:
  const Mesh& whole_;
  Mesh mesh_;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers_;
};

}  // namespace

std::vector<FieldMesh> meshes_of_field(const Field& field, const std::optional<Bounds>& clip,
                                       const MesherOptions& options) {
  const Bounds box = box_to_keep(field, clip);
  if (field.empty() || box.empty()) return {};
  const Mesh whole = mesh_of_field(
      [&](std::span<const Vec3> points, std::span<float> out) { field.distance(points, out); }, box,
      options);
  const std::vector<Owner> owners = owners_of_triangles(field, whole);
  std::map<std::pair<std::uint32_t, std::uint32_t>, Part> parts;
  for (std::size_t i = 0; i < owners.size(); ++i) {
    const std::uint32_t* corner = &whole.indices[3 * i];
    if (has_no_area(whole.positions[corner[0]], whole.positions[corner[1]],
                    whole.positions[corner[2]]))
      continue;
    parts.try_emplace({owners[i].object, owners[i].material}, whole).first->second.add(i);
  }
  std::vector<FieldMesh> meshes;
  meshes.reserve(parts.size());
  for (auto& [owner, part] : parts) meshes.push_back({part.take(), owner.first, owner.second});
  return meshes;
}

}  // namespace penumbra::sdf
