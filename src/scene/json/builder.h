// The scene while its sections are read, and these sections. Internal to the JSON reader.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/json/object_reader.h"
#include "scene/scene.h"

namespace penumbra::json {

/// What a model file became: its instances as the file places them.
struct Model {
  std::vector<Instance> instances;
};

/// The scene that a document describes at `time`, seconds; unfinished. InputError with the place.
Scene read_scene(const Document& document, double time = 0);

struct Builder {
  const Document& document;
  double time = 0;  ///< of models that move
  Scene scene{};
  std::map<std::string, std::uint32_t, std::less<>> materials{};  ///< index by name
  std::map<std::string, int> textures{};                ///< index by path; -1 = cannot be decoded
  std::map<std::string, Model> models{};                ///< by path: a file is read once
  std::map<std::uint32_t, std::uint32_t> untextured{};  ///< copies of materials
  std::vector<Light> sphere_lights{};                   ///< from emissive sphere objects
  struct Window {
    Light light;
    TextureSlot texture;
  };
  std::vector<Window> windows{};  ///< rect lights with a texture
};

/// "camera" or "cameras" of the scene object.
void read_cameras(Builder& builder, ObjectReader& scene);
/// Before objects: these name materials.
void read_materials(Builder& builder, const Json::Value& materials);
void read_lights(Builder& builder, const Json::Value& lights);
/// The windows as objects, after all others.
void add_windows(Builder& builder);
/// Also appends sphere_lights to the lights, so after read_lights.
void read_objects(Builder& builder, const Json::Value& objects);

/// The image that a member names, repeated; none if it is absent or cannot be decoded.
TextureSlot optional_texture(Builder& builder, ObjectReader& reader, const char* key);

/// The "material" of an object.
std::uint32_t required_material(Builder& builder, ObjectReader& object);
std::optional<std::uint32_t> optional_material(Builder& builder, ObjectReader& object);
/// Analytic shapes have no texture coordinates: they take a copy of the material without texture.
/// `things` names them in the warning.
std::uint32_t untextured(Builder& builder, std::uint32_t material, std::string_view things);

// The types of object; `object` is the index into Scene::objects.
void read_quad(Builder& builder, ObjectReader& reader, std::uint32_t object);
void read_sphere(Builder& builder, ObjectReader& reader, std::uint32_t object);
void read_box(Builder& builder, ObjectReader& reader, std::uint32_t object);
void read_polygon(Builder& builder, ObjectReader& reader, std::uint32_t object);
void read_mesh(Builder& builder, ObjectReader& reader, std::uint32_t object);
void read_sdf(Builder& builder, ObjectReader& reader, std::uint32_t object);
void read_glsl(Builder& builder, ObjectReader& reader, std::uint32_t object);

/// Throws InputError at "edge_v" if "edge_u" and "edge_v" span no area.
void refuse_parallel_edges(const ObjectReader& reader, const Vec3d& u, const Vec3d& v);

/// A parallelogram with texture coordinates whose upper left is the picture's.
Mesh quad_mesh(const Vec3d& corner, const Vec3d& u, const Vec3d& v);

/// Adds a mesh that stands where its vertices say.
void add_mesh(Builder& builder, Mesh mesh, std::uint32_t material, std::uint32_t object);

}  // namespace penumbra::json
