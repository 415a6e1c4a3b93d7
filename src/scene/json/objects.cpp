#include <fmt/format.h>

#include "base/cancel.h"
#include "scene/json/builder.h"
#include "scene/json/keyframes.h"

namespace penumbra::json {
namespace {

using ObjectFunction = void (*)(Builder&, ObjectReader&, std::uint32_t);
constexpr TypeEntry<ObjectFunction> object_types[] = {
    {"quad", read_quad}, {"sphere", read_sphere}, {"box", read_box},  {"polygon", read_polygon},
    {"mesh", read_mesh}, {"sdf", read_sdf},       {"glsl", read_glsl}};

std::string name_of(ObjectReader& reader, std::size_t index) {
  const std::string kind = reader.noun().substr(reader.noun().find(' ') + 1);
  const std::string type = kind.substr(0, kind.find(' '));
  return reader.optional("name", text, fmt::format("{} {}", type, index));
}

}  // namespace

void read_objects(Builder& builder, const Json::Value& objects) {
  Scene& scene = builder.scene;
  for (const Json::Value& value : objects) {
    throw_if_cancelled();
    ObjectReader reader(builder.document, value, "an object");
    const ObjectFunction read = choose_by_type(reader, object_types);
    const std::size_t index = scene.objects.size();
    Object& object = scene.objects.emplace_back();
    object.name = name_of(reader, index);
    object.receives = reader.optional("receives", flag, true);
    object.samples_scale = reader.optional("samples_scale", samples_scale, 1.0f);
    know_keyframes(reader);
    read(builder, reader, static_cast<std::uint32_t>(index));
  }
  scene.lights.insert(scene.lights.end(), builder.sphere_lights.begin(),
                      builder.sphere_lights.end());
}

void add_mesh(Builder& builder, Mesh mesh, std::uint32_t material, std::uint32_t object) {
  Scene& scene = builder.scene;
  mesh.name = scene.objects[object].name;
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  instance.material = material;
  instance.object = object;
  scene.instances.push_back(instance);
  scene.meshes.push_back(std::move(mesh));
}

}  // namespace penumbra::json
