#include <numbers>

#include "scene/json/builder.h"
#include "scene/json/keyframes.h"

namespace penumbra::json {
namespace {

void sphere_light(ObjectReader& reader, Light& light) {
  light.type = LightType::sphere;
  light.position = reader.required("position", point);
  light.radius = reader.required("radius", positive);
  light.emission = reader.required("radiance", light_colour);
  reader.done();
}

void disk_light(ObjectReader& reader, Light& light) {
  light.type = LightType::disk;
  light.position = reader.required("position", point);
  const Vec3 normal = reader.required("normal", nonzero_vector);
  light.radius = reader.required("radius", positive);
  light.emission = reader.required("radiance", light_colour);
  reader.done();
  light.normal = Vec3(normalize(Vec3d(normal)));
}

void rect_light(ObjectReader& reader, Light& light) {
  light.type = LightType::rect;
  const Vec3d corner(reader.required("corner", point));
  const Vec3d u(light.edge_u = reader.required("edge_u", nonzero_vector));
  const Vec3d v(light.edge_v = reader.required("edge_v", nonzero_vector));
  light.emission = reader.required("radiance", light_colour);
  reader.done();
  refuse_parallel_edges(reader, u, v);
  light.position = Vec3(corner + (u + v) * 0.5);
  light.normal = Vec3(normalize(cross(u, v)));
}

void segment_light(ObjectReader& reader, Light& light) {
  light.type = LightType::segment;
  const Vec3d from(reader.required("from", point));
  const Vec3d to(reader.required("to", point));
  light.radius = reader.required("radius", positive);
  light.emission = reader.required("radiance", light_colour);
  reader.done();
  if (length(to - from) < 1e-12)
    reader.refuse_key("to", "the segment light has no length", "move \"from\" or \"to\"");
  light.position = Vec3((from + to) * 0.5);
  light.edge_u = Vec3(to - from);
}

void point_light(ObjectReader& reader, Light& light) {
  light.type = LightType::point;
  light.position = reader.required("position", point);
  light.emission = reader.required("intensity", light_colour);
  reader.done();
}

void sun_light(ObjectReader& reader, Light& light) {
  light.type = LightType::sun;
  const Vec3 direction = reader.required("direction", nonzero_vector);
  light.angular_diameter = reader.optional("angular_diameter_deg", angular_diameter_deg, 0.53f) *
                           std::numbers::pi_v<float> / 180.0f;
  light.emission = reader.required("irradiance", light_colour);
  reader.done();
  light.direction = Vec3(normalize(Vec3d(direction)));
}

/// A rect light with a texture is a surface that glows: seen, and in the way of other lights.
void add_textured_rect(Builder& builder, const Light& light, const TextureSlot& texture) {
  Scene& scene = builder.scene;
  Material material;
  material.name = light.name;
  material.diffuse = {};
  material.emission = light.emission;
  material.emission_map = texture;
  material.emission_map.wrap_s = material.emission_map.wrap_t = Wrap::clamp;
  material.emission_map_lights = true;
  material.double_sided = false;
  const auto number = static_cast<std::uint32_t>(scene.materials.size());
  scene.materials.push_back(material);
  const auto object = static_cast<std::uint32_t>(scene.objects.size());
  scene.objects.push_back({light.name.empty() ? "window" : light.name, true});
  const Vec3d u(light.edge_u), v(light.edge_v);
  Mesh mesh = quad_mesh(Vec3d(light.position) - (u + v) * 0.5, u, v);
  mesh.name = scene.objects.back().name;
  add_mesh(builder, std::move(mesh), number, object);
}

using LightFunction = void (*)(ObjectReader&, Light&);
constexpr TypeEntry<LightFunction> light_types[] = {
    {"sphere", sphere_light},   {"disk", disk_light},   {"rect", rect_light},
    {"segment", segment_light}, {"point", point_light}, {"sun", sun_light}};

}  // namespace

void read_lights(Builder& builder, const Json::Value& lights) {
  for (const Json::Value& value : lights) {
    ObjectReader reader(builder.document, value, "a light");
    const LightFunction read = choose_by_type(reader, light_types);
    Light& light = builder.scene.lights.emplace_back();
    light.name = reader.optional<std::string>("name", text, {});
    const bool is_rect = read == rect_light;
    const TextureSlot texture =
        is_rect ? optional_texture(builder, reader, "texture") : TextureSlot{};
    know_keyframes(reader);
    read(reader, light);
    if (!texture.used()) continue;
    builder.windows.push_back({light, texture});
    builder.scene.lights.pop_back();
  }
}

void add_windows(Builder& builder) {
  for (const Builder::Window& w : builder.windows) add_textured_rect(builder, w.light, w.texture);
}

}  // namespace penumbra::json
