// A scene's distance field as GLSL.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"
#include "sdf/mesh_distance.h"

namespace penumbra::sdf {

struct GlslField {
  std::string text;
  std::vector<float> mesh_texels;  ///< four floats a texel, for pnb_mesh_texels; see mesh.glsl
  bool has_meshes = false;         ///< by pnb_mesh_texels; the text defines PNB_MESHES then
  std::vector<std::string> warnings;
};

/// True if the scene has anything that generate_glsl would write.
bool has_shapes(const Scene& scene);

/// The field of a scene as GLSL ES 3.00, with the values of the tape (compile.h): the shapes'
/// functions, a function for each sdf object, then
///   float pnb_scene(vec3 p)
///   float pnb_scene_surface(vec3 p)   the same where no solid but the sdf objects has an inside
///   float pnb_scene_signed(vec3 p)    of the object whose surface is nearest to p
///   bool pnb_scene_is_rounded(vec3 p)   true where an sdf object's surface is nearest
///   float pnb_scene_shapes(vec3 p)   pnb_scene_surface without meshes that are in the texture
///   pnb_Material pnb_scene_material(vec3 p, out float d)   of these; d: pnb_scene_shapes(p)
/// The second leaves out the instance whose number is in pnb_left_out if that is a mesh light.
/// Before it must stand the type pnb_Material, int pnb_left_out, pnb_material_of(int) for indices
/// into Scene::materials, and pnb_mix_materials(a, b, share of b). Works without recursion: any
/// depth. Other meshes than boxes, quads and polygons take their distances from `meshes`, by a
/// texture with mesh_texels, in rows of mesh_texel_row; InputError for one where that is empty.
GlslField generate_glsl(const Scene& scene, const MeshDistances& meshes = {});
inline constexpr int mesh_texel_row = 4096;

}  // namespace penumbra::sdf
