#include <algorithm>
#include <functional>

#include "scene/json/builder.h"
#include "scene/json/keyframes.h"
#include "scene/load.h"

namespace penumbra {

Scene json::read_scene(const Document& document, double time) {
  Builder builder{document, time};
  Scene& scene = builder.scene;
  scene.report.format = "Penumbra scene (JSON)";

  const std::optional<Moment> moment = moment_of(document, time);
  if (moment) scene.keyframe_times = moment->times;
  ObjectReader reader(document, moment ? moment->root : document.root(), "the scene");
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
  auto& times = scene.keyframe_times;
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return std::move(builder.scene);
}

Scene read_json_scene(const std::string& path, const LoadOptions& options) {
  return json::read_scene(json::Document(path), options.time);
}

}  // namespace penumbra
