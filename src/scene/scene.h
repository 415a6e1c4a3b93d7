// What is there: the scene as every reader produces it and every renderer takes it.
// World frame: right-handed, Y up, metres. Radiance in W·sr⁻¹·m⁻² (or nits), linear sRGB.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/affine.h"
#include "base/vec.h"
#include "image/texture.h"
#include "scene/sdf.h"

namespace penumbra {

struct Material {
  std::string name;
  Vec3 diffuse{0.8f, 0.8f, 0.8f};      ///< albedo in [0, 1]
  Vec3 specular{0, 0, 0};              ///< reflectance at normal incidence, in [0, 1]
  float roughness = 0.5f;              ///< GGX perceptual roughness in [0, 1]
  Vec3 mirror{0, 0, 0};                ///< fraction reflected as by a mirror, in [0, 1]
  Vec3 emission{0, 0, 0};              ///< radiance
  TextureSlot diffuse_map;             ///< sRGB; multiplies diffuse
  TextureSlot metallic_roughness_map;  ///< linear; green · roughness, blue · metallic
  TextureSlot emission_map;            ///< sRGB; multiplies emission
  bool emission_map_lights = false;    ///< with an emission map its surface is a light too
  float metallic = 0;  ///< glTF: diffuse and specular are mixed from base colour by this
  bool is_metallic_roughness = false;  ///< glTF: diffuse is the base colour, see metallic
  bool double_sided = true;            ///< seen and shaded from both sides
  std::optional<float> alpha_cutoff;   ///< MASK: texels with alpha · alpha < cutoff are holes
  float alpha = 1;                     ///< base colour's alpha factor
  /// glTF, KHR_materials_unlit: the radiance that a base colour of 1 shows as, whatever the lights;
  /// 0 = lit. Without double_sided nothing is seen of it from behind.
  float unlit = 0;
};

// What a mesh was before it became triangles, for distances to it.
struct ExactBox {
  Vec3 lo, hi;
};
struct ExactQuad {
  Vec3 corner, edge_u, edge_v;
};
struct ExactPolygon {
  std::vector<Vec3> vertices;  ///< in order around its border
};

/// A triangle mesh of one material slot. Triangles wind counter-clockwise seen from the front.
struct Mesh {
  std::string name;
  std::string file;  ///< that it was read from; empty if it is in none of its own
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;           ///< per vertex, unit; empty = geometric
  std::vector<Vec2> uv[2];             ///< per vertex; may be empty
  std::vector<Vec3> colors;            ///< per vertex, multiply diffuse; empty = white
  std::vector<std::uint32_t> indices;  ///< 3 a triangle, all in range, no zero-area triangle

  /// Set only while the positions are still those of the object in the file.
  std::variant<std::monostate, ExactBox, ExactQuad, ExactPolygon> exact;

  std::size_t triangle_count() const { return indices.size() / 3; }
};

/// A mesh placed in the world.
struct Instance {
  std::uint32_t mesh = 0;
  std::uint32_t material = 0;
  std::uint32_t object = 0;  ///< index into Scene::objects
  int mesh_light = -1;       ///< index of the light whose surface this is; -1 = none
  Affine world_from_mesh;
};

/// An analytic sphere.
struct Sphere {
  Vec3 center;
  float radius = 0;
  std::uint32_t material = 0;
  std::uint32_t object = 0;
};

/// What a person calls one thing: composites other than min act between objects.
struct Object {
  std::string name;
  bool receives = true;     ///< baking: its surfaces hold light and shadows in textures
  float samples_scale = 1;  ///< baking: multiplies the points on each light for its surfaces
};

enum class LightType : std::uint8_t { point, sphere, disk, rect, segment, sun, mesh };
const char* to_string(LightType type);

/// Any light. Only the fields of its type (in comments) matter.
struct Light {
  LightType type = LightType::point;
  std::string name;
  Vec3 position;  ///< centre: point, sphere, disk, rect, segment (its middle)
  Vec3 normal;    ///< disk, rect: unit, the side that emits. Spot: the axis it shines along
  Vec3 edge_u,
      edge_v;  ///< rect: whole edges, edge_u × edge_v along normal. segment: to − from in u
  float radius = 0;            ///< sphere, disk, segment
  Vec3 direction;              ///< sun: unit, the way light travels
  float angular_diameter = 0;  ///< sun: radians
  Vec3 emission;               ///< radiance; point: intensity; sun: irradiance on a facing surface
  float spot_cos_inner = -1, spot_cos_outer = -1;  ///< point, sphere: full inside; −1 = all
  int instance = -1;          ///< mesh: index into Scene::instances of the emitting surface
  bool double_sided = false;  ///< mesh: emits to both sides
};

struct Camera {
  std::string name;
  Vec3 position;
  Vec3 look_at;
  Vec3 up{0, 1, 0};
  float vertical_fov = 0.7f;          ///< radians; perspective
  std::optional<float> ortho_height;  ///< metres seen from top to bottom; orthographic if set
};

/// A remark about loading that `info` and the log repeat.
struct LoadReport {
  std::vector<std::string> warnings;     ///< something in the file could not be honoured
  std::vector<std::string> conversions;  ///< what was changed: defaults added, meshes split
  std::uint64_t dropped_triangles = 0;   ///< zero area
  std::string format;                    ///< "glTF 2.0 (binary)", "Stanford PLY (ascii)" …
};

struct Scene {
  std::vector<TextureImage> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Sphere> spheres;
  std::vector<SdfTree> sdfs;
  std::optional<GlslSource> glsl;  ///< only the GL renderer shows it
  std::vector<Object> objects;
  std::vector<Light> lights;
  std::vector<Camera> cameras;
  Vec3 ambient{0.05f, 0.05f, 0.05f};   ///< radiance from everywhere, unoccluded
  bool ambient_is_automatic = false;   ///< the file says nothing of it: renderers follow the light
  Vec3 background{0, 0, 0};            ///< radiance where a ray meets nothing
  std::vector<double> keyframe_times;  ///< of all that moves, seconds, ascending; empty: nothing
  std::optional<float> exposure_ev;    ///< that the file asks to be shown with; none = by renderers
  bool stores_visibility = false;      ///< glTF: the file holds what is seen of its lights, baked
  LoadReport report;
};

/// World bounds of all instances, spheres and bounded distance fields.
Bounds bounds_of(const Scene& scene);
Bounds bounds_of(const Scene& scene, const Instance& instance);

}  // namespace penumbra
