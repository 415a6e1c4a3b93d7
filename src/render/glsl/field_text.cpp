#include "render/glsl/field_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace penumbra {
namespace {

constexpr float kReach = 50;  // of the distance of what the camera looks at

constexpr const char* kMaterialType = R"(
struct pnb_Material {
  vec3 diffuse, specular, mirror, emission;
  float alpha;  // GGX roughness
};
)";

std::string user_functions(const UserShader& user) {
  const char* albedo = user.has_albedo ? "clamp(albedo(p), 0.0, 1.0)" : "vec3(0.8)";
  return fmt::format(R"(
float pnb_map(vec3 p) {{ return map(p); }}

pnb_Material pnb_material(vec3 p) {{
  return pnb_Material({}, vec3(0.0), vec3(0.0), vec3(0.0), 1.0);
}}
)",
                     albedo);
}

Bounds looked_at(const Camera& camera) {
  const Vec3 half(kReach * std::max(length(camera.look_at - camera.position), 1e-3f));
  return {camera.look_at - half, camera.look_at + half};
}

}  // namespace

FieldText field_text(const Scene& scene, const Camera& camera, bool prefer_map) {
  FieldText field;
  if (scene.glsl) {
    field.user = read_user_shader(scene.glsl->path, scene.glsl->text);
    if (prefer_map && field.user->has_map) field.user->has_main_image = false;
  }
  field.box = looked_at(camera);
  if (!field.own_picture()) field.generated = kMaterialType + user_functions(*field.user);
  return field;
}

}  // namespace penumbra
