#include "geometry/world.h"

#include <algorithm>

#include "geometry/cone_tree.h"
#include "geometry/embree_scene.h"
#include "scene/extent.h"
#include "sdf/field.h"
#include "sdf/mesher.h"
#include "sdf/met_surface.h"

namespace penumbra {

namespace {

std::shared_ptr<const sdf::Field> solids_of(const Scene& scene) {
  if (scene.sdfs.empty()) return nullptr;
  sdf::FieldOptions options;
  options.only_distance_fields = true;
  return std::make_shared<const sdf::Field>(scene, options);
}

std::shared_ptr<const sdf::Field> field_of(const Scene& scene,
                                           const sdf::ConversionOptions& conversions) {
  sdf::FieldOptions options;
  options.mesh_distance = sdf::mesh_distances(conversions);
  return std::make_shared<const sdf::Field>(scene, options);
}

std::unique_ptr<const Scene> triangulate(const Scene& scene, const sdf::Field& solids,
                                         const sdf::ConversionOptions& conversions) {
  auto out = std::make_unique<Scene>(scene);
  for (auto& part : sdf::meshes_of_field(solids, conversions.bounds, {conversions.voxel_size})) {
    const auto mesh = static_cast<std::uint32_t>(out->meshes.size());
    out->meshes.push_back(std::move(part.mesh));
    out->instances.push_back({mesh, part.material, part.object, -1, {}});
  }
  return out;
}

float voxel_of(const sdf::Field& solids, const sdf::ConversionOptions& conversions) {
  if (conversions.voxel_size) return static_cast<float>(*conversions.voxel_size);
  return max_component(conversions.bounds.value_or(solids.bounds()).size()) / 128;
}

}  // namespace

World::World(const Scene& scene, const WorldOptions& options)
    : scene_(scene),
      bounds_(bounds_of(scene)),
      extent_(extent_of(scene)),
      sun_bounds_(penumbra::sun_bounds(scene)),
      embree_(std::make_unique<EmbreeScene>(scene)),
      solids_(solids_of(scene)) {
  if (options.cone_tree) {
    if (solids_) {
      triangulated_ = triangulate(scene, *solids_, options.conversions);
      // An arc of radius r over a chord of one voxel v rises v² / 8r: a twentieth of v where r is
      // 2.5 voxels, the tightest hollow that such triangles still show.
      sagitta_ = 0.05f * voxel_of(*solids_, options.conversions);
    }
    cone_tree_ = std::make_unique<ConeTree>(triangulated_ ? *triangulated_ : scene);
  }
  const bool only_solids = solids_ && scene.instances.empty() && scene.spheres.empty();
  if (options.field) field_ = only_solids ? solids_ : field_of(scene, options.conversions);
}

World::~World() = default;

std::optional<Hit> World::intersect(const Ray& ray) const {
  auto hit = embree_->intersect(ray);
  if (solids_) march(std::span(&ray, 1), &hit);
  return hit;
}

std::uint64_t World::intersect(std::span<const Ray> rays, std::optional<Hit>* hits) const {
  const bool only_solids = solids_ && scene_.instances.empty() && scene_.spheres.empty();
  if (only_solids) std::fill_n(hits, rays.size(), std::nullopt);
  for (std::size_t first = 0; first < rays.size() && !only_solids; first += 8)
    embree_->intersect(rays.subspan(first, std::min<std::size_t>(8, rays.size() - first)),
                       hits + first);
  return solids_ ? march(rays, hits) : 0;
}

float World::epsilon_at(const Vec3& p) const {
  // Eight roundings of 2^-24: a hit point is a sum of three products of coordinates about as large
  // as its own, seen through a normal that was rounded too. Near the origin of a small scene the
  // vertices around it still have the scene's magnitude, a sixteenth of which counts.
  return roundings() * std::max(max_component(abs(p)), extent_.diagonal() / 16);
}

sdf::PointError World::point_error() const { return {roundings(), extent_.diagonal() / 16}; }

float World::clearance_epsilon_at(const Vec3& p) const { return std::max(epsilon_at(p), sagitta_); }

float World::roundings() const {
  // Where a march ends is less exact than where a ray meets a triangle: a ray from there must begin
  // beyond the march's own tolerance, 3e-7 of the coordinates, even where f grows at a tenth of the
  // way as it may where fields blend (solid_surface).
  return solids_ ? 0x1p-18f : 0x1p-21f;
}

std::vector<std::string> World::warnings() const {
  if (field_) return field_->warnings();
  return solids_ ? solids_->warnings() : std::vector<std::string>();
}

std::size_t World::memory_bytes() const {
  std::size_t bytes = cone_tree_ ? cone_tree_->memory_bytes() : 0;
  if (solids_) bytes += solids_->memory_bytes();
  if (field_ && field_ != solids_) bytes += field_->memory_bytes();
  return bytes;
}

}  // namespace penumbra
