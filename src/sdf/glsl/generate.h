// A scene's distance field as GLSL.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace penumbra::sdf {

struct GlslField {
  std::string text;
  std::vector<std::string> warnings;
};

/// True if the scene has anything that generate_glsl would write.
bool has_shapes(const Scene& scene);

/// The sdf objects, spheres, boxes, quads and polygons of a scene as GLSL ES 3.00, with the values
/// of the tape (compile.h): the shapes' functions, a function for each sdf object, then
///   float pnb_scene(vec3 p)
///   pnb_Material pnb_scene_material(vec3 p, out float d)   d: pnb_scene(p)
/// Before it must stand the type pnb_Material, pnb_material_of(int) for indices into
/// Scene::materials, and pnb_mix_materials(a, b, share of b). Works without recursion: any depth.
/// Throws InputError for a mesh of another kind, which has no formula.
GlslField generate_glsl(const Scene& scene);

}  // namespace penumbra::sdf
