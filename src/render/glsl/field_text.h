// A scene's distance field as GLSL.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/glsl/image_bytes.h"
#include "render/glsl/user_shader.h"
#include "scene/scene.h"
#include "sdf/mesh_distance.h"

namespace penumbra {

/// What is drawn: a field that our functions march, from a person's shader, the scene's own shapes
/// or both; or a picture of the shader's own.
struct FieldText {
  std::optional<UserShader> user;
  std::string generated;  ///< GLSL: pnb_Material, pnb_map and what else trace.glsl asks for
  bool glossy = false;    ///< some material has a glossy lobe
  bool mirrors = false;   ///< some material is a mirror
  Bounds box;             ///< the scene's box enlarged by its diagonal: marches to suns end there
  float sight = 0;        ///< how far rays go, metres; 0 = to where they leave the box
  std::vector<float> mesh_texels;    ///< see sdf::GlslField
  std::vector<std::uint8_t> images;  ///< of textures, for image_lookup.glsl, in image_texel_row
  std::vector<float> masks;          ///< of cut-out textures, for mask_lookup.glsl
  std::vector<std::string> warnings;

  /// Runs the shader's mainImage.
  bool own_picture() const { return user && user->has_main_image; }
};

/// The field of a scene. `prefer_map`: of a shader with map and mainImage, map counts.
/// Meshes take their distances from `meshes`; without them they are refused.
FieldText field_text(const Scene& scene, bool prefer_map, const sdf::MeshDistances& meshes = {});

}  // namespace penumbra
