#include "render/glsl/field_text.h"

#include <fmt/format.h>

#include "base/error.h"
#include "render/glsl/mask_text.h"
#include "render/glsl/material_text.h"
#include "render/glsl/shader_text.h"
#include "scene/extent.h"
#include "sdf/glsl/generate.h"

namespace penumbra {
namespace {

const char* user_material(const UserShader& user) {
  return user.has_albedo ? "pnb_Material(clamp(albedo(p), 0.0, 1.0), vec3(0.0), vec3(0.0), "
                           "vec3(0.0), 1.0)"
                         : "pnb_Material(vec3(0.8), vec3(0.0), vec3(0.0), vec3(0.0), 1.0)";
}

// What trace.glsl and surface.glsl ask of a field, from the person's map alone.
std::string functions_of_map(const UserShader& user) {
  return fmt::format(
      "\nfloat pnb_map(vec3 p) {{ return map(p); }}\n#define pnb_surface pnb_map\n"
      "#define pnb_signed pnb_map\n#define pnb_shapes pnb_map\n\n"
      "bool pnb_is_rounded(vec3 p) {{ return false; }}\n\n"
      "pnb_Material pnb_material(vec3 p) {{\n  return {};\n}}\n",
      user_material(user));
}

// From the scene's shapes, with or without a person's map.
std::string functions_of_scene(const std::optional<UserShader>& user) {
  const auto with_map = [&](const char* name, const char* join = "min") {
    return user ? fmt::format("{}(map(p), pnb_scene{}(p))", join, name)
                : fmt::format("pnb_scene{}(p)", name);
  };
  return fmt::format(
      "\nfloat pnb_map(vec3 p) {{ return {}; }}\n\n"
      "float pnb_surface(vec3 p) {{ return {}; }}\n\n"
      "float pnb_signed(vec3 p) {{ return {}; }}\n\n"
      "float pnb_shapes(vec3 p) {{ return {}; }}\n\n"
      "bool pnb_is_rounded(vec3 p) {{ return pnb_scene_is_rounded(p){}; }}\n\n"
      "pnb_Material pnb_material(vec3 p) {{\n  float d;\n"
      "  pnb_Material m = pnb_scene_material(p, d);\n{}  return m;\n}}\n",
      with_map(""), with_map("_surface"), with_map("_signed", "pnb_nearer"), with_map("_shapes"),
      user ? " && map(p) > pnb_scene_surface(p)" : "",
      user ? fmt::format("  if (map(p) < d) return {};\n", user_material(*user)) : "");
}

Bounds enlarged(Bounds box) {
  const Vec3 diagonal(box.diagonal());
  return {box.lo - diagonal, box.hi + diagonal};
}

void note_materials(const Scene& scene, FieldText& field) {
  std::vector<std::uint32_t> used;
  for (const SdfTree& tree : scene.sdfs)
    for (const SdfNode& node : tree.nodes) used.push_back(node.material);
  for (const Sphere& sphere : scene.spheres) used.push_back(sphere.material);
  for (const Instance& instance : scene.instances) used.push_back(instance.material);
  for (const std::uint32_t i : used) {
    const Material& m = scene.materials[i];
    field.glossy = field.glossy || m.is_metallic_roughness || max_component(m.specular) > 0;
    field.mirrors = field.mirrors || max_component(m.mirror) > 0;
  }
}

void warn_of_textures(const Scene& scene, std::vector<std::string>& warnings) {
  std::vector<bool> used(scene.materials.size());
  for (const Instance& instance : scene.instances) used[instance.material] = true;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Material& m = scene.materials[i];
    if (used[i] && (m.diffuse_map.used() || m.metallic_roughness_map.used()))
      warnings.push_back(fmt::format(
          "the texture of material \"{}\" is left out in a shader that stands alone", m.name));
  }
}

}  // namespace

FieldText field_text(const Scene& scene, bool prefer_map, const sdf::MeshDistances& meshes) {
  FieldText field;
  if (scene.glsl) {
    field.user = read_user_shader(scene.glsl->path, scene.glsl->text);
    if (prefer_map && field.user->has_map) field.user->has_main_image = false;
    if (field.own_picture()) return field;
    if (!field.user->has_map)
      throw InputError({field.user->file}, "the shader has a mainImage and no map",
                       "give it a float map(vec3 p), or render its picture");
  }
  field.box = enlarged(sun_bounds(scene));
  if (!is_bounded(scene)) field.sight = sight_in_diagonals * extent_of(scene).diagonal();
  field.generated =
      material_type() + "\nint pnb_left_out = -1;  // an instance that does not block\n";
  const bool shapes = sdf::has_shapes(scene);
  if (shapes) {
    sdf::GlslField scene_field = sdf::generate_glsl(scene, meshes);
    field.mesh_texels = std::move(scene_field.mesh_texels);
    field.generated += material_functions(scene) + scene_field.text;
    if (scene_field.has_meshes) {
      ImageBytes images;
      const std::string materials = facet_materials(scene, images);
      field.images = images.take();
      if (!field.images.empty()) field.generated += shader_text("image_lookup.glsl");
      field.generated += materials + mask_functions(scene, field.masks);
    }
    field.warnings = std::move(scene_field.warnings);
    if (!meshes) warn_of_textures(scene, field.warnings);
    note_materials(scene, field);
  }
  field.generated += shapes ? functions_of_scene(field.user) : functions_of_map(*field.user);
  return field;
}

}  // namespace penumbra
