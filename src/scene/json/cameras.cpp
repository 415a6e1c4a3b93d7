#include <numbers>

#include "scene/json/builder.h"
#include "scene/json/keyframes.h"

namespace penumbra::json {
namespace {

Camera read_camera(const Document& document, const Json::Value& value, const std::string& name) {
  ObjectReader reader(document, value, "a camera");
  Camera camera;
  camera.name = name;
  camera.position = reader.required("position", point);
  camera.look_at = reader.required("look_at", point);
  camera.up = reader.optional("up", nonzero_vector, camera.up);
  camera.vertical_fov = reader.optional("vertical_fov_deg", field_of_view_deg, 40.0f) *
                        std::numbers::pi_v<float> / 180.0f;
  know_keyframes(reader);
  reader.done();

  const Vec3d view = Vec3d(camera.look_at) - Vec3d(camera.position);
  const Vec3d up(camera.up);
  if (length(view) < 1e-12)
    reader.refuse_key("look_at", "the camera looks at its own position",
                      "move \"look_at\" or \"position\"");
  if (length(cross(view, up)) < 1e-6 * length(view) * length(up))
    reader.refuse_key("up", "\"up\" of the camera points along its view",
                      "give an \"up\" across the view, such as [0, 0, 1]");
  return camera;
}

}  // namespace

void read_cameras(Builder& builder, ObjectReader& scene) {
  const Document& document = builder.document;
  const Json::Value* one = scene.find("camera");
  const Json::Value* several = scene.optional<const Json::Value*>("cameras", object, nullptr);
  if (one && several)
    scene.refuse_key("cameras", "both \"camera\" and \"cameras\" are given",
                     "put every camera under \"cameras\"");
  std::vector<Camera>& cameras = builder.scene.cameras;
  if (one) cameras.push_back(read_camera(document, *one, "camera"));
  if (!several) return;
  for (const Member& member : members_in_file_order(*several))
    cameras.push_back(read_camera(document, *member.value, member.key));
}

}  // namespace penumbra::json
