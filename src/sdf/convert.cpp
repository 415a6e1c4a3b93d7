#include "sdf/convert.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "sdf/mesh_grid.h"

namespace penumbra::sdf {
namespace {

constexpr std::size_t most_lines = 20;  // about meshes

class PlacedGrid : public MeshDistance {
 public:
  /// world_from_mesh keeps angles.
  PlacedGrid(std::shared_ptr<const MeshGrid> grid, const Affine& world_from_mesh)
      : grid_(std::move(grid)),
        mesh_from_world_(inverse(world_from_mesh)),
        scale_(static_cast<float>(length(world_from_mesh.x))) {}

  void distance(const float* x, const float* y, const float* z, std::size_t count,
                float* out) const override {
    for (std::size_t i = 0; i < count; ++i)
      out[i] = scale_ * grid_->distance(mesh_from_world_.point(Vec3(x[i], y[i], z[i])));
  }
  DistanceRange range(const Vec3& center, float radius) const override {
    const DistanceRange r = grid_->range(mesh_from_world_.point(center), radius / scale_);
    return {scale_ * r.lo, scale_ * r.hi};
  }
  std::size_t memory_bytes() const override { return grid_->memory_bytes(); }
  std::optional<Placed> placed_grid() const override {
    return Placed{grid_.get(), mesh_from_world_, scale_};
  }

 private:
  std::shared_ptr<const MeshGrid> grid_;
  Affine mesh_from_world_;
  float scale_;
};

Mesh in_world(const Mesh& mesh, const Affine& world_from_mesh) {
  Mesh world;
  world.name = mesh.name;
  world.indices = mesh.indices;
  for (const Vec3& p : mesh.positions) world.positions.push_back(world_from_mesh.point(p));
  if (world_from_mesh.determinant() < 0)
    for (std::size_t i = 0; i + 2 < world.indices.size(); i += 3)
      std::swap(world.indices[i + 1], world.indices[i + 2]);
  return world;
}

GridOptions grid_options(const Scene& scene, const Instance& instance,
                         const ConversionOptions& options) {
  GridOptions grid;
  if (options.voxel_size)
    grid.voxel_size = *options.voxel_size / length(instance.world_from_mesh.x);
  const std::string& file = scene.meshes[instance.mesh].file;
  if (options.keep_files && !file.empty())
    grid.cache = fmt::format("{}.{}.distance.vdb", file, instance.mesh);
  return grid;
}

class Maker {
 public:
  explicit Maker(const ConversionOptions& options) : options_(options) {}

  std::shared_ptr<const MeshDistance> make(const Scene& scene, std::size_t number) {
    const Instance& instance = scene.instances[number];
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (!is_similarity(instance.world_from_mesh))
      return std::make_shared<PlacedGrid>(
          std::make_shared<MeshGrid>(in_world(mesh, instance.world_from_mesh),
                                     GridOptions{.voxel_size = options_.voxel_size}),
          Affine{});
    const GridOptions grid = grid_options(scene, instance, options_);
    const std::lock_guard lock(mutex_);
    auto& shared = grids_[{instance.mesh, grid.voxel_size.value_or(0)}];
    if (!shared) shared = std::make_shared<MeshGrid>(mesh, grid);
    return std::make_shared<PlacedGrid>(shared, instance.world_from_mesh);
  }

 private:
  ConversionOptions options_;
  std::mutex mutex_;
  std::map<std::pair<std::uint32_t, double>, std::shared_ptr<const MeshGrid>> grids_;
};

// Empty if the instance's mesh is exact.
std::string line_about(const Scene& scene, const Instance& instance,
                       const ConversionOptions& options) {
  const Mesh& mesh = scene.meshes[instance.mesh];
  if (!std::holds_alternative<std::monostate>(mesh.exact)) return "";
  const bool is_shared = is_similarity(instance.world_from_mesh);
  const GridOptions grid = is_shared ? grid_options(scene, instance, options)
                                     : GridOptions{.voxel_size = options.voxel_size};
  const Mesh moved = is_shared ? Mesh{} : in_world(mesh, instance.world_from_mesh);
  const double voxel = is_shared ? voxel_size_of(mesh, grid) * length(instance.world_from_mesh.x)
                                 : voxel_size_of(moved, grid);
  return fmt::format("mesh \"{}\" has distances by a grid of {:.4g} m voxels{}", mesh.name, voxel,
                     is_shared && is_cached(mesh, grid) ? " (cached)" : "");
}

std::string line_about_fields(const Scene& scene, const ConversionOptions& options) {
  const auto is_unbounded = [](const SdfTree& tree) {
    const Bounds box = bounds_of(tree);
    return !box.empty() && !is_finite(box);
  };
  if (!options.bounds && std::ranges::any_of(scene.sdfs, is_unbounded))
    return "a distance field without end becomes triangles only within --bounds";
  Bounds box;
  for (const SdfTree& tree : scene.sdfs) box.grow(bounds_of(tree));
  if (options.bounds) box = *options.bounds;
  const double voxel = options.voxel_size.value_or(max_component(box.size()) / 128.0);
  return fmt::format("distance fields become triangles of some {:.4g} m where a method needs them",
                     voxel);
}

}  // namespace

MeshDistances mesh_distances(const ConversionOptions& options) {
  return [maker = std::make_shared<Maker>(options)](const Scene& scene, std::size_t instance) {
    return maker->make(scene, instance);
  };
}

std::vector<std::string> describe_conversions(const Scene& scene,
                                              const ConversionOptions& options) {
  std::vector<std::string> lines;
  std::size_t count = 0;
  for (const Instance& instance : scene.instances) {
    std::string text = line_about(scene, instance, options);
    if (!text.empty() && std::ranges::find(lines, text) == lines.end() && count++ < most_lines)
      lines.push_back(std::move(text));
  }
  if (count > most_lines)
    lines.push_back(fmt::format("and so have {} more meshes", count - most_lines));
  if (!scene.sdfs.empty()) lines.push_back(line_about_fields(scene, options));
  return lines;
}

}  // namespace penumbra::sdf
