// Scene files of every kind, by their extension.
#pragma once

#include <string>

#include "scene/scene.h"

namespace penumbra {

struct LoadOptions {
  bool add_missing_camera_and_light = true;
  double time = 0;  ///< seconds: where keyframes and animations put what moves
};

/// Loads .json, .gltf, .glb, .obj, .ply, .ply.gz, .stl, .glsl and finishes the scene (finish.h).
/// Throws InputError with the place. Not to be called from several threads on one Scene.
Scene load_scene(const std::string& path, const LoadOptions& options = {});

// The readers behind it; each gives an unfinished scene.
Scene read_json_scene(const std::string& path, const LoadOptions& options = {});
/// The first animation moves its nodes.
Scene read_gltf(const std::string& path, const LoadOptions& options = {});
Scene read_obj(const std::string& path);
Scene read_ply(const std::string& path);
Scene read_stl(const std::string& path);

/// Reads a mesh file of any of the triangle formats (.obj .ply .ply.gz .stl .gltf .glb): a scene of
/// materials, meshes and instances; its cameras and lights too if it has any.
Scene read_model(const std::string& path, const LoadOptions& options = {});

}  // namespace penumbra
