#include "scene/gltf/rule_table.h"

namespace penumbra::gltf {
namespace {

constexpr bool kRequired = true;
const std::string kLights = "extensions.KHR_lights_punctual.lights";
const std::string kAreaLights = "extensions.EXT_lights_area.lights";

using Rules = std::vector<Rule>;

void add_data_rules(Rules& rules) {
  rules.push_back({"buffers[].byteLength", Kind::count, {}, 0, kRequired});
  rules.push_back({"buffers[].uri", Kind::text});
  rules.push_back({"bufferViews[].buffer", Kind::index, "buffers", 0, kRequired});
  rules.push_back({"bufferViews[].byteOffset", Kind::count});
  rules.push_back({"bufferViews[].byteLength", Kind::count, {}, 0, kRequired});
  rules.push_back({"bufferViews[].byteStride", Kind::stride});
}

void add_accessor_rules(Rules& rules) {
  const std::string a = "accessors[].", s = a + "sparse.";
  rules.push_back({a + "bufferView", Kind::index, "bufferViews"});
  rules.push_back({a + "byteOffset", Kind::count});
  rules.push_back(
      {a + "componentType", Kind::number_of, "5120|5121|5122|5123|5125|5126", 0, kRequired});
  rules.push_back({a + "normalized", Kind::flag});
  rules.push_back({a + "count", Kind::count, {}, 0, kRequired});
  rules.push_back(
      {a + "type", Kind::word_of, "SCALAR|VEC2|VEC3|VEC4|MAT2|MAT3|MAT4", 0, kRequired});
  rules.push_back({s + "count", Kind::int_count, {}, 0, kRequired});
  rules.push_back({s + "indices", Kind::object, {}, 0, kRequired});
  rules.push_back({s + "indices.bufferView", Kind::index, "bufferViews", 0, kRequired});
  rules.push_back({s + "indices.byteOffset", Kind::int_count});
  rules.push_back({s + "indices.componentType", Kind::number_of, "5121|5123|5125", 0, kRequired});
  rules.push_back({s + "values", Kind::object, {}, 0, kRequired});
  rules.push_back({s + "values.bufferView", Kind::index, "bufferViews", 0, kRequired});
  rules.push_back({s + "values.byteOffset", Kind::int_count});
}

void add_mesh_rules(Rules& rules) {
  const std::string p = "meshes[].primitives[].";
  rules.push_back({"meshes[].name", Kind::text});
  rules.push_back({"meshes[].primitives", Kind::list, {}, 0, kRequired});
  rules.push_back({p + "attributes", Kind::object, {}, 0, kRequired});
  rules.push_back({p + "attributes.*", Kind::index, "accessors"});
  rules.push_back({p + "indices", Kind::index, "accessors"});
  rules.push_back({p + "material", Kind::index, "materials"});
  rules.push_back({p + "mode", Kind::number_of, "0|1|2|3|4|5|6"});
  rules.push_back({p + "targets[]", Kind::object});
}

void add_node_rules(Rules& rules) {
  const std::string n = "nodes[].", e = n + "extensions.";
  rules.push_back({n + "name", Kind::text});
  rules.push_back({n + "mesh", Kind::index, "meshes"});
  rules.push_back({n + "camera", Kind::index, "cameras"});
  rules.push_back({n + "skin", Kind::index, "skins"});
  rules.push_back({n + "children", Kind::indices, "nodes"});
  rules.push_back({n + "matrix", Kind::numbers, {}, 16});
  rules.push_back({n + "translation", Kind::numbers, {}, 3});
  rules.push_back({n + "rotation", Kind::numbers, {}, 4});
  rules.push_back({n + "scale", Kind::numbers, {}, 3});
  rules.push_back({e + "KHR_lights_punctual.light", Kind::index, kLights, 0, kRequired});
  rules.push_back({e + "EXT_lights_area.light", Kind::index, kAreaLights, 0, kRequired});
  rules.push_back({"scene", Kind::index, "scenes"});
  rules.push_back({"scenes[].name", Kind::text});
  rules.push_back({"scenes[].nodes", Kind::indices, "nodes"});
}

void add_animation_rules(Rules& rules) {
  const std::string a = "animations[].", c = a + "channels[].", s = a + "samplers[].";
  rules.push_back({a + "name", Kind::text});
  rules.push_back({a + "channels", Kind::list, {}, 0, kRequired});
  rules.push_back({c + "sampler", Kind::int_count, {}, 0, kRequired});
  rules.push_back({c + "target", Kind::object, {}, 0, kRequired});
  rules.push_back({c + "target.node", Kind::index, "nodes"});
  rules.push_back({c + "target.path", Kind::text, {}, 0, kRequired});
  rules.push_back({a + "samplers", Kind::list, {}, 0, kRequired});
  rules.push_back({s + "input", Kind::index, "accessors", 0, kRequired});
  rules.push_back({s + "output", Kind::index, "accessors", 0, kRequired});
  rules.push_back({s + "interpolation", Kind::word_of, "LINEAR|STEP|CUBICSPLINE"});
}

/// A reference to a texture, with KHR_texture_transform.
void add_slot_rules(Rules& rules, const std::string& slot) {
  const std::string t = slot + ".extensions.KHR_texture_transform.";
  rules.push_back({slot, Kind::object});
  rules.push_back({slot + ".index", Kind::index, "textures", 0, kRequired});
  rules.push_back({slot + ".texCoord", Kind::int_count});
  rules.push_back({t + "offset", Kind::numbers, {}, 2});
  rules.push_back({t + "rotation", Kind::number});
  rules.push_back({t + "scale", Kind::numbers, {}, 2});
  rules.push_back({t + "texCoord", Kind::int_count});
}

void add_material_rules(Rules& rules) {
  const std::string m = "materials[].", p = m + "pbrMetallicRoughness.";
  rules.push_back({m + "name", Kind::text});
  rules.push_back({p + "baseColorFactor", Kind::numbers, {}, 4});
  rules.push_back({p + "metallicFactor", Kind::number});
  rules.push_back({p + "roughnessFactor", Kind::number});
  add_slot_rules(rules, p + "baseColorTexture");
  add_slot_rules(rules, p + "metallicRoughnessTexture");
  add_slot_rules(rules, m + "emissiveTexture");
  rules.push_back({m + "emissiveFactor", Kind::color});
  rules.push_back(
      {m + "extensions.KHR_materials_emissive_strength.emissiveStrength", Kind::not_negative});
  rules.push_back({m + "alphaMode", Kind::word_of, "OPAQUE|MASK|BLEND"});
  rules.push_back({m + "alphaCutoff", Kind::number});
  rules.push_back({m + "doubleSided", Kind::flag});
}

void add_texture_rules(Rules& rules) {
  rules.push_back({"textures[].source", Kind::index, "images"});
  rules.push_back({"textures[].sampler", Kind::index, "samplers"});
  rules.push_back({"images[].name", Kind::text});
  rules.push_back({"images[].uri", Kind::text});
  rules.push_back({"images[].bufferView", Kind::index, "bufferViews"});
  rules.push_back({"samplers[].magFilter", Kind::int_count});
  rules.push_back({"samplers[].wrapS", Kind::number_of, "10497|33071|33648"});
  rules.push_back({"samplers[].wrapT", Kind::number_of, "10497|33071|33648"});
}

void add_camera_rules(Rules& rules) {
  const std::string c = "cameras[].", o = c + "orthographic.";
  rules.push_back({c + "name", Kind::text});
  rules.push_back({c + "type", Kind::word_of, "perspective|orthographic", 0, kRequired});
  rules.push_back({c + "perspective.yfov", Kind::positive, {}, 0, kRequired});
  rules.push_back({c + "perspective.znear", Kind::number, {}, 0, kRequired});
  for (const char* name : {"xmag", "ymag", "zfar", "znear"})
    rules.push_back({o + name, Kind::number, {}, 0, kRequired});
}

void add_light_rules(Rules& rules) {
  const std::string l = kLights + "[].", a = kAreaLights + "[].";
  for (const std::string& each : {l, a}) {
    rules.push_back({each + "name", Kind::text});
    rules.push_back({each + "color", Kind::color});
    rules.push_back({each + "intensity", Kind::not_negative});
  }
  rules.push_back({l + "type", Kind::word_of, "point|spot|directional", 0, kRequired});
  rules.push_back({l + "spot.innerConeAngle", Kind::not_negative});
  rules.push_back({l + "spot.outerConeAngle", Kind::positive});
  rules.push_back({a + "type", Kind::word_of, "rect|disk"});
  rules.push_back({a + "shape", Kind::word_of, "rect|disk"});
  rules.push_back({a + "size", Kind::positive});
  rules.push_back({a + "aspect", Kind::positive});
  rules.push_back({a + "rect.aspect", Kind::positive});
}

}  // namespace

std::span<const Rule> declaration_rules() {
  static const Rules table = {{"asset", Kind::object, {}, 0, kRequired},
                              {"asset.version", Kind::text, {}, 0, kRequired},
                              {"extensionsUsed[]", Kind::text},
                              {"extensionsRequired[]", Kind::text}};
  return table;
}

std::span<const Rule> document_rules() {
  static const Rules table = [] {
    Rules rules;
    for (const auto add :
         {add_data_rules, add_accessor_rules, add_mesh_rules, add_node_rules, add_material_rules,
          add_texture_rules, add_camera_rules, add_light_rules, add_animation_rules})
      add(rules);
    return rules;
  }();
  return table;
}

}  // namespace penumbra::gltf
