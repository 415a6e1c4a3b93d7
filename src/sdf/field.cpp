#include "sdf/field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/extent.h"
#include "sdf/blend.h"
#include "sdf/compile.h"
#include "sdf/field_data.h"

namespace penumbra::sdf {
namespace {

// Bounds of what the field holds, unbounded trees aside.
Bounds bounds_in(const Scene& scene, const FieldOptions& options, bool& is_bounded) {
  Bounds bounds;
  for (const SdfTree& tree : scene.sdfs) {
    bounds.grow(bounds_of_finite_parts(tree));
    const Bounds box = bounds_of(tree);
    is_bounded = is_bounded && (box.empty() || is_finite(box));
  }
  if (options.only_distance_fields) return bounds;
  for (const Sphere& s : scene.spheres) {
    bounds.grow(s.center - Vec3(s.radius));
    bounds.grow(s.center + Vec3(s.radius));
  }
  for (const Instance& instance : scene.instances) bounds.grow(bounds_of(scene, instance));
  return bounds;
}

Bounds enlarged(Bounds box, float by) {
  box.lo = box.lo - Vec3(by), box.hi = box.hi + Vec3(by);
  return box;
}

// Where rays will be: the box enlarged by its diagonal, where marches towards a sun end, and
// cameras and lights that are not far beyond.
Bounds region_of_rays(const Scene& scene, const Bounds& bounds) {
  Bounds box = enlarged(bounds, bounds.diagonal());
  const Bounds most = enlarged(bounds, 6 * bounds.diagonal());
  const auto reach = [&](const Vec3& p) { box.grow(max(min(p, most.hi), most.lo)); };
  for (const Camera& camera : scene.cameras) reach(camera.position);
  for (const Light& light : scene.lights)
    if (light.type != LightType::sun) reach(light.position);
  return box;
}

Regions regions_for(const FieldData& data, const Scene& scene, const FieldOptions& options) {
  const bool has_box = !data.bounds.empty() && data.bounds.diagonal() > 0;
  const Bounds box = has_box ? data.bounds : extent_of(scene);
  RegionLimits limits;
  limits.bytes = options.region_bytes;
  limits.enabled = options.prune;
  return build_regions(data.tape, enlarged(box, 0.15f * box.diagonal()), region_of_rays(scene, box),
                       limits);
}

Points& columns_of(std::span<const Vec3> points) {
  thread_local Points columns;
  columns.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) columns.set(i, points[i]);
  return columns;
}

}  // namespace

Field::Field(const Scene& scene, const FieldOptions& options)
    : data_(std::make_unique<FieldData>()) {
  data_->tape = compile(scene, {options.only_distance_fields, options.mesh_distance});
  if (!options.prune) data_->tape.runs.clear();
  data_->bounds = bounds_in(scene, options, data_->is_bounded);
  data_->regions = regions_for(*data_, scene, options);
}

Field::~Field() = default;
Field::Field(Field&&) noexcept = default;
Field& Field::operator=(Field&&) noexcept = default;

bool Field::empty() const { return data_->tape.code.empty(); }

float Field::distance(const Vec3& p) const {
  float d;
  distance({&p, 1}, {&d, 1});
  return d;
}

void Field::distance(std::span<const Vec3> points, std::span<float> out) const {
  if (empty()) {
    std::ranges::fill(out, std::numeric_limits<float>::infinity());
    return;
  }
  const Points& c = columns_of(points);
  distances(*data_, c.x.data(), c.y.data(), c.z.data(), points.size(), out.data());
}

float Field::normal_step(const Vec3& p) { return 1e-3f * std::max(max_component(abs(p)), 1e-3f); }

void Field::normal(std::span<const Vec3> points, std::span<Vec3> out, float step) const {
  const Points& c = columns_of(points);
  thread_local std::vector<float> steps;
  thread_local Points found;
  steps.resize(points.size()), found.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    steps[i] = step > 0 ? step : normal_step(points[i]);
  normals(*data_, c, steps.data(), points.size(), found);
  for (std::size_t i = 0; i < points.size(); ++i) out[i] = found[i];
}

void Field::owners(std::span<const Vec3> points, std::span<Owner> out) const {
  // Blends of one surface with itself are it.
  if (const auto& all = data_->tape.surfaces; all.size() == 1) {
    std::ranges::fill(out, Owner{all[0].object, all[0].material, false});
    return;
  }
  const Points& c = columns_of(points);
  for (std::size_t i = 0; i < points.size(); i += 16) {
    const std::size_t n = std::min<std::size_t>(16, points.size() - i);
    std::uint32_t surface[16];
    std::uint8_t blended[16];
    sdf::owners(*data_, &c.x[i], &c.y[i], &c.z[i], n, surface, blended);
    for (std::size_t k = 0; k < n; ++k) {
      const Surface& s = data_->tape.surfaces[surface[k]];
      out[i + k] = {s.object, s.material, blended[k] != 0};
    }
  }
}

SurfaceAt Field::surface(const Vec3& p) const {
  Owner owner;
  owners({&p, 1}, {&owner, 1});
  if (!owner.blended) return {owner.object, {{owner.material, 1.0f}}};
  return blend_at(*data_, p);
}

const Bounds& Field::bounds() const { return data_->bounds; }
bool Field::is_bounded() const { return data_->is_bounded; }
const std::vector<std::string>& Field::warnings() const { return data_->tape.warnings; }
std::size_t Field::code_size() const { return data_->tape.code.size(); }
std::size_t Field::region_codes() const { return data_->regions.codes.size(); }

std::size_t Field::memory_bytes() const {
  std::size_t bytes =
      sizeof(FieldData) + data_->tape.memory_bytes() + data_->regions.memory_bytes();
  for (const auto& mesh : data_->tape.meshes) bytes += mesh->memory_bytes();
  return bytes;
}

std::vector<std::string> field_warnings(const Scene& scene) {
  return compile(scene, {.only_distance_fields = true, .mesh_distance = {}}).warnings;
}

}  // namespace penumbra::sdf
