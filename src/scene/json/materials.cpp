#include <fmt/format.h>

#include <filesystem>

#include "base/atomic_file.h"
#include "scene/json/builder.h"

namespace penumbra::json {
namespace {

// The index of the texture in the scene, or -1 with a warning if it cannot be had.
int texture_of(Builder& builder, const std::string& path) {
  const auto [entry, is_new] = builder.textures.try_emplace(path, -1);
  if (!is_new) return entry->second;
  Scene& scene = builder.scene;
  const std::string bytes = read_file(path);
  TextureImage image;
  if (!decode_texture(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), image)) {
    scene.report.warnings.push_back(
        fmt::format("{}: the image cannot be decoded; it counts as white", path));
    return -1;
  }
  image.name = std::filesystem::path(path).filename().string();
  scene.textures.push_back(std::move(image));
  return entry->second = static_cast<int>(scene.textures.size()) - 1;
}

Material read_material(Builder& builder, const Member& member) {
  ObjectReader reader(builder.document, *member.value, "a material");
  Material material;
  material.name = member.key;
  material.diffuse = reader.optional("diffuse", albedo, material.diffuse);
  material.specular = reader.optional("specular", albedo, material.specular);
  material.roughness = reader.optional("roughness", unit_interval, material.roughness);
  material.mirror = reader.optional("mirror", albedo_or_grey, material.mirror);
  material.emission = reader.optional("emission", light_colour, material.emission);
  material.diffuse_map = optional_texture(builder, reader, "texture");
  material.emission_map = optional_texture(builder, reader, "emission_texture");
  material.emission_map_lights = true;
  reader.done();
  return material;
}

std::uint32_t material_named(Builder& builder, ObjectReader& object, const std::string& name) {
  if (const auto found = builder.materials.find(name); found != builder.materials.end())
    return found->second;
  std::vector<std::string_view> names;
  names.reserve(builder.materials.size());
  for (const auto& [known, index] : builder.materials) names.push_back(known);
  object.refuse_key(
      "material", fmt::format("unknown material \"{}\"", name),
      names.empty() ? "define it under \"materials\"" : suggest(name, names, List::no));
}

}  // namespace

TextureSlot optional_texture(Builder& builder, ObjectReader& reader, const char* key) {
  TextureSlot slot;
  const std::string name = reader.optional<std::string>(key, file_name, {});
  if (name.empty()) return slot;
  const std::optional<std::string> path = builder.document.find_file(name);
  if (!path)
    reader.refuse_key(key, fmt::format("there is no image file \"{}\"", name),
                      "name a PNG or JPEG file, relative to the scene file");
  slot.image = texture_of(builder, *path);
  return slot;
}

void read_materials(Builder& builder, const Json::Value& materials) {
  for (const Member& member : members_in_file_order(materials)) {
    builder.materials[member.key] = static_cast<std::uint32_t>(builder.scene.materials.size());
    builder.scene.materials.push_back(read_material(builder, member));
  }
}

std::uint32_t required_material(Builder& builder, ObjectReader& object) {
  const std::string name = object.required("material", text);
  return object.find("material") ? material_named(builder, object, name) : 0;
}

std::optional<std::uint32_t> optional_material(Builder& builder, ObjectReader& object) {
  if (!object.find("material")) return {};
  return material_named(builder, object, object.required("material", text));
}

std::uint32_t untextured(Builder& builder, std::uint32_t material, std::string_view things) {
  std::vector<Material>& materials = builder.scene.materials;
  if (!materials[material].diffuse_map.used() && !materials[material].emission_map.used())
    return material;
  const auto next = static_cast<std::uint32_t>(materials.size());
  const auto [copy, is_new] = builder.untextured.try_emplace(material, next);
  if (!is_new) return copy->second;
  materials.push_back(Material(materials[material]));
  materials.back().diffuse_map = materials.back().emission_map = {};
  builder.scene.report.warnings.push_back(fmt::format(
      "{} have no texture coordinates: the texture of material \"{}\" is left out there", things,
      materials.back().name));
  return next;
}

}  // namespace penumbra::json
