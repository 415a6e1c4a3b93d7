// The steps of finish_scene, one file each.
#pragma once

#include <string>

#include "scene/scene.h"

namespace penumbra {

/// "mesh 'name'" or "mesh 3" if it has no name.
std::string quoted_name(const Scene& scene, std::uint32_t mesh);

/// Refuses vertices, spheres and transforms that no ray can be traced against (InputError).
void check_geometry(const Scene& scene, const std::string& file);

/// The same for cameras and lights: squares of distances to them must stay within floats.
void check_cameras_and_lights(const Scene& scene, const std::string& file);

/// Gives every emissive instance a mesh of its own, as far as memory allows (warning otherwise).
void unshare_emissive_meshes(Scene& scene);

/// Applies the transform of meshes used once to their vertices.
void bake_transforms(Scene& scene);

/// Replaces texture coordinates that are not finite by 0 and vertex normals that have no direction
/// by those of the adjacent triangles; other normals become unit vectors.
void repair_attributes(Scene& scene);

/// Removes triangles without area, then instances without triangles, then meshes without instances.
void drop_degenerate(Scene& scene);

/// Splits emissive instances into connected parts with one mesh light each; of a coloured emission
/// texture one for each colour channel.
void add_mesh_lights(Scene& scene);

/// True if the material makes its surface a light: it emits, without a texture for it or with one
/// that lights too.
bool is_light_material(const Material& material);

}  // namespace penumbra
