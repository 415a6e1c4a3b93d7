#include <functional>

#include "scene/json/builder.h"
#include "scene/load.h"

namespace penumbra {

Scene json::read_scene(const Document& document) {
  Builder builder{document};
  Scene& scene = builder.scene;
  scene.report.format = "Penumbra scene (JSON)";

  ObjectReader reader(document, document.root(), "the scene");
  reader.optional<std::string>("$schema", text, {});
  read_cameras(builder, reader);
  const Json::Value* materials = reader.optional<const Json::Value*>("materials", object, nullptr);
  const Json::Value* objects = reader.required<const Json::Value*>("objects", array);
  const Json::Value* lights = reader.optional<const Json::Value*>("lights", array, nullptr);
  scene.ambient = reader.optional("ambient", light_colour, scene.ambient);
  scene.background = reader.optional("background", light_colour, scene.background);
  reader.done();

  if (materials) read_materials(builder, *materials);
  if (lights) read_lights(builder, *lights);
  read_objects(builder, *objects);
  add_windows(builder);
  return std::move(builder.scene);
}

Scene read_json_scene(const std::string& path) { return json::read_scene(json::Document(path)); }

}  // namespace penumbra
