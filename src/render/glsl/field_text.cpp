#include "render/glsl/field_text.h"

#include <fmt/format.h>

#include "base/error.h"
#include "render/glsl/material_text.h"
#include "scene/extent.h"
#include "sdf/glsl/generate.h"

namespace penumbra {
namespace {

const char* user_material(const UserShader& user) {
  return user.has_albedo ? "pnb_Material(clamp(albedo(p), 0.0, 1.0), vec3(0.0), vec3(0.0), "
                           "vec3(0.0), 1.0)"
                         : "pnb_Material(vec3(0.8), vec3(0.0), vec3(0.0), vec3(0.0), 1.0)";
}

// pnb_map and pnb_material from the person's map, the scene's shapes or both.
std::string joined(const FieldText& field, bool shapes) {
  if (!shapes)
    return fmt::format(
        "\nfloat pnb_map(vec3 p) {{ return map(p); }}\n#define pnb_surface pnb_map\n"
        "#define pnb_signed pnb_map\n\n"
        "pnb_Material pnb_material(vec3 p) {{\n  return {};\n}}\n",
        user_material(*field.user));
  const std::string mine = field.user ? "min(map(p), pnb_scene(p))" : "pnb_scene(p)";
  const std::string choice =
      field.user ? fmt::format("  if (map(p) < d) return {};\n", user_material(*field.user)) : "";
  return fmt::format(
      "\nfloat pnb_map(vec3 p) {{ return {}; }}\n\n"
      "float pnb_surface(vec3 p) {{ return {}; }}\n\n"
      "float pnb_signed(vec3 p) {{ return {}; }}\n\n"
      "pnb_Material pnb_material(vec3 p) {{\n  float d;\n"
      "  pnb_Material m = pnb_scene_material(p, d);\n{}  return m;\n}}\n",
      mine, field.user ? "min(map(p), pnb_scene_surface(p))" : "pnb_scene_surface(p)",
      field.user ? "pnb_nearer(map(p), pnb_scene_signed(p))" : "pnb_scene_signed(p)", choice);
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
  field.generated = material_type() + "\nint pnb_own = -1;  // an instance that does not block\n";
  const bool shapes = sdf::has_shapes(scene);
  if (shapes) {
    sdf::GlslField scene_field = sdf::generate_glsl(scene, meshes);
    field.mesh_texels = std::move(scene_field.mesh_texels);
    field.generated += material_functions(scene, field.warnings) + scene_field.text;
    field.warnings.insert(field.warnings.end(), scene_field.warnings.begin(),
                          scene_field.warnings.end());
    note_materials(scene, field);
  }
  field.generated += joined(field, shapes);
  return field;
}

}  // namespace penumbra
