#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/rotation.h"
#include "scene/json/builder.h"
#include "scene/load.h"

namespace penumbra::json {
namespace {

Affine scaling(const Vec3d& s) { return {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, {}}; }

// Scaled, then turned about x, y and z in this order, then moved.
Affine read_transform(const Document& document, const Json::Value& value) {
  ObjectReader reader(document, value, "a transform");
  const Vec3d translate(reader.optional("translate", point, Vec3{}));
  const Vec3d degrees = reader.optional("rotate_deg", angles_deg, Vec3d{});
  const Vec3d factors = reader.optional("scale", scale, Vec3d{1, 1, 1});
  reader.done();
  Affine moved;
  moved.t = translate;
  return moved * rotation_deg(degrees) * scaling(factors);
}

template <class T>
void append(std::vector<T>& to, std::vector<T>& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

void shift_textures(std::vector<Material>& materials, int first) {
  for (Material& m : materials)
    for (TextureSlot* slot : {&m.diffuse_map, &m.metallic_roughness_map, &m.emission_map})
      if (slot->used()) slot->image += first;
}

void append_report(LoadReport& to, LoadReport& from) {
  append(to.warnings, from.warnings);
  append(to.conversions, from.conversions);
  to.dropped_triangles += from.dropped_triangles;
}

bool has_triangles(const Scene& model) {
  return std::ranges::any_of(model.instances, [&](const Instance& instance) {
    return model.meshes[instance.mesh].triangle_count() > 0;
  });
}

// Moves everything but the instances into the scene; these are kept with their numbers shifted.
Model take_over(Scene& scene, Scene& model, const std::string& file) {
  const auto meshes = static_cast<std::uint32_t>(scene.meshes.size());
  const auto materials = static_cast<std::uint32_t>(scene.materials.size());
  shift_textures(model.materials, static_cast<int>(scene.textures.size()));
  for (Instance& instance : model.instances) {
    instance.mesh += meshes;
    instance.material += materials;
  }
  if (!model.lights.empty() || !model.cameras.empty())
    scene.report.conversions.push_back(
        fmt::format("the lights and cameras of the model {} are left out", file));
  append(scene.textures, model.textures);
  append(scene.materials, model.materials);
  append(scene.meshes, model.meshes);
  append(scene.keyframe_times, model.keyframe_times);
  append_report(scene.report, model.report);
  return {std::move(model.instances)};
}

const Model& model_of(Builder& builder, const ObjectReader& reader, const std::string& file) {
  const std::optional<std::string> path = builder.document.find_file(file);
  if (!path)
    reader.refuse_key("file", fmt::format("there is no model file \"{}\"", file),
                      "name one relative to the scene file");
  if (const auto known = builder.models.find(*path); known != builder.models.end())
    return known->second;
  Scene model = read_model(*path, {.time = builder.time});
  if (!has_triangles(model))
    reader.refuse_key("file", fmt::format("the model file \"{}\" holds no triangle", file),
                      "name a file with triangles");
  return builder.models[*path] = take_over(builder.scene, model, file);
}

}  // namespace

void read_mesh(Builder& builder, ObjectReader& reader, std::uint32_t object) {
  const std::string file = reader.required("file", file_name);
  const Json::Value* transform = reader.find("transform");
  const std::optional<std::uint32_t> material = optional_material(builder, reader);
  reader.done();
  const Affine world_from_model =
      transform ? read_transform(builder.document, *transform) : Affine{};
  for (Instance instance : model_of(builder, reader, file).instances) {
    instance.world_from_mesh = world_from_model * instance.world_from_mesh;
    instance.material = material.value_or(instance.material);
    instance.object = object;
    builder.scene.instances.push_back(instance);
  }
}

}  // namespace penumbra::json
