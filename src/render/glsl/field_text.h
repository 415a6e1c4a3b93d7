// A scene's distance field as GLSL.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/glsl/user_shader.h"
#include "scene/scene.h"

namespace penumbra {

/// What is drawn: a field that our functions march, from a person's shader, the scene's own shapes
/// or both; or a picture of the shader's own.
struct FieldText {
  std::optional<UserShader> user;
  std::string generated;    ///< GLSL: pnb_Material, pnb_map, pnb_material
  bool glossy = false;      ///< some material has a glossy lobe
  bool mirrors = false;     ///< some material is a mirror
  Bounds box;               ///< where surfaces are looked for
  float sun_reach = 1e30f;  ///< how far marches towards a sun go at most, metres
  std::vector<std::string> warnings;

  /// Runs the shader's mainImage.
  bool own_picture() const { return user && user->has_main_image; }
};

/// The field of a scene. `prefer_map`: of a shader with map and mainImage, map counts. A field
/// without bounds is looked at to 50 times the distance of what the camera looks at, and marched
/// through towards a sun for 10 times that distance.
FieldText field_text(const Scene& scene, const Camera& camera, bool prefer_map);

}  // namespace penumbra
