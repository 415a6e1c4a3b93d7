// The published schema says what the reader does.
#include <gtest/gtest.h>
#include <json/reader.h>

#include <memory>
#include <set>
#include <sstream>

#include "json_support.h"
#include "scene/starter.h"

namespace penumbra::test {
namespace {

using Names = std::set<std::string>;

const Json::Value& schema() {
  static const Json::Value value = [] {
    Json::Value v;
    std::istringstream text{std::string(scene_schema())};
    text >> v;
    return v;
  }();
  return value;
}

const Json::Value& definition(const std::string& name) { return schema()["$defs"][name]; }

Names keys_in_schema(const Json::Value& type) {
  const auto names = type["properties"].getMemberNames();
  return {names.begin(), names.end()};
}

// What the reader names as known when it meets a key, or type, that it does not know.
Names known_to_reader(const std::string& scene) {
  const std::string message = error_of(scene);
  const std::size_t begin = message.find("(known: ");
  EXPECT_NE(begin, std::string::npos) << message;
  Names names;
  std::istringstream list(message.substr(begin + 8, message.find(')', begin) - begin - 8));
  for (std::string name; std::getline(list >> std::ws, name, ',');) names.insert(name);
  return names;
}

Names types_in_schema(const std::string& noun) {
  Names names;
  for (const Json::Value& name : definition(noun)["properties"]["type"]["enum"])
    names.insert(name.asString());
  return names;
}

std::string of_type(const std::string& type) {
  return std::string(R"({"unknown!": 0, "type": ")").append(type).append("\"}");
}

// The object that `required` describes with one key left out, filled with values of its kinds.
Json::Value sample_of(const Json::Value& kind) {
  if (kind.isMember("const")) return kind["const"];
  const std::string ref = kind["$ref"].asString();
  const std::string name = ref.substr(ref.rfind('/') + 1);
  if (name == "text" || name == "file") return "floor";
  if (name == "positive") return 1;
  Json::Value vector(Json::arrayValue);
  for (const int x : {1, 2, 3}) vector.append(x);
  return vector;
}

TEST(JsonSchema, FileInDocsIsTheSame) {
  EXPECT_EQ(read_file(PENUMBRA_SOURCE_DIR "/docs/scene.schema.json"), scene_schema());
}

TEST(JsonSchema, Root) {
  EXPECT_EQ(known_to_reader(R"({"unknown!": 0})"), keys_in_schema(schema()));
}

TEST(JsonSchema, CamerasMaterialsTransforms) {
  EXPECT_EQ(known_to_reader(with_camera(R"({"unknown!": 0})")),
            keys_in_schema(definition("camera")));
  EXPECT_EQ(known_to_reader(with_material(R"({"unknown!": 0})")),
            keys_in_schema(definition("material")));
  EXPECT_EQ(known_to_reader(
                with_object(R"({"type": "mesh", "file": "s.json", "transform": {"unknown!": 0}})")),
            keys_in_schema(definition("transform")));
}

TEST(JsonSchema, TypesOfObjectsAndLights) {
  EXPECT_EQ(known_to_reader(with_object(of_type("unknown!"))), types_in_schema("object"));
  EXPECT_EQ(known_to_reader(with_light(of_type("unknown!"))), types_in_schema("light"));
}

TEST(JsonSchema, KeysOfEveryType) {
  for (const std::string& type : types_in_schema("object"))
    EXPECT_EQ(known_to_reader(with_object(of_type(type))),
              keys_in_schema(definition(type + "_object")))
        << type;
  for (const std::string& type : types_in_schema("light"))
    EXPECT_EQ(known_to_reader(with_light(of_type(type))),
              keys_in_schema(definition(type + "_light")))
        << type;
}

void expect_required(const std::string& noun, std::string (*wrap)(const std::string&)) {
  for (const std::string& type : types_in_schema(noun)) {
    const Json::Value& required =
        definition(std::string(type).append("_").append(noun))["required"];
    const Json::Value& properties =
        definition(std::string(type).append("_").append(noun))["properties"];
    for (const Json::Value& left_out : required) {
      Json::Value object;
      for (const Json::Value& key : required)
        if (key != left_out) object[key.asString()] = sample_of(properties[key.asString()]);
      const std::string message = error_of(wrap(object.toStyledString()));
      const std::string expected = "missing key \"" + left_out.asString() + "\"";
      EXPECT_NE(message.find(expected), std::string::npos) << type << ": " << message;
    }
  }
}

TEST(JsonSchema, RequiredKeysOfObjects) { expect_required("object", with_object); }
TEST(JsonSchema, RequiredKeysOfLights) { expect_required("light", with_light); }

TEST(JsonSchema, DefaultsAreTheReaders) {
  const Scene scene = read_text(R"({"objects": [], "materials": {"m": {}},
      "camera": {"position": [0, 0, 1], "look_at": [0, 0, 0]},
      "lights": [{"type": "sun", "direction": [0, -1, 0], "irradiance": [1, 1, 1]}]})");
  const auto vector = [](const Json::Value& v) {
    return Vec3(v[0].asFloat(), v[1].asFloat(), v[2].asFloat());
  };
  const Json::Value& camera = definition("camera")["properties"];
  const Json::Value& material = definition("material")["properties"];
  const float degree = std::acos(-1.0f) / 180;
  EXPECT_EQ(scene.ambient, vector(schema()["properties"]["ambient"]["default"]));
  EXPECT_EQ(scene.background, vector(schema()["properties"]["background"]["default"]));
  EXPECT_EQ(scene.cameras[0].up, vector(camera["up"]["default"]));
  EXPECT_FLOAT_EQ(scene.cameras[0].vertical_fov,
                  camera["vertical_fov_deg"]["default"].asFloat() * degree);
  EXPECT_EQ(scene.materials[0].diffuse, vector(material["diffuse"]["default"]));
  EXPECT_EQ(scene.materials[0].specular, vector(material["specular"]["default"]));
  EXPECT_EQ(scene.materials[0].emission, vector(material["emission"]["default"]));
  EXPECT_EQ(scene.materials[0].roughness, material["roughness"]["default"].asFloat());
  EXPECT_EQ(scene.materials[0].mirror, Vec3(material["mirror"]["default"].asFloat()));
  EXPECT_FLOAT_EQ(
      scene.lights[0].angular_diameter,
      definition("sun_light")["properties"]["angular_diameter_deg"]["default"].asFloat() * degree);
}

// An editor refuses what the reader refuses: no object of the schema is open but keyframes, whose
// keys are those of the thing that has them.
void expect_closed(const Json::Value& value, const std::string& where) {
  if (where == "/$defs/keyframes") return;
  if (value.isObject() && value.isMember("properties") && !value.isMember("oneOf")) {
    EXPECT_TRUE(value.isMember("additionalProperties") &&
                value["additionalProperties"] == Json::Value(false))
        << where;
  }
  if (!value.isObject()) return;
  for (const std::string& name : value.getMemberNames())
    expect_closed(value[name], std::string(where).append("/").append(name));
}

TEST(JsonSchema, IsClosed) { expect_closed(schema(), ""); }

std::string sdf_with_root(const Json::Value& root) {
  return R"({"type": "sdf", "material": "floor", "root": )" + root.toStyledString() + "}";
}

Json::Value node_of(const SdfSignature& signature) {
  Json::Value node;
  node[signature.kind == SdfKind::shape ? "shape" : "op"] = signature.name;
  return node;
}

TEST(JsonSchema, KeysOfEveryDistanceFieldNode) {
  for (const SdfSignature& signature : sdf_signatures()) {
    Json::Value node = node_of(signature);
    node["unknown!"] = 0;
    Names known = known_to_reader(with_object(sdf_with_root(node)));
    known.erase(signature.kind == SdfKind::shape ? "op" : "shape");
    EXPECT_EQ(known, keys_in_schema(definition(std::string("sdf_") + signature.name)))
        << signature.name;
  }
}

TEST(JsonSchema, EveryDistanceFieldNodeIsListed) {
  EXPECT_EQ(definition("sdf_node")["oneOf"].size(), sdf_signatures().size());
  for (const SdfSignature& signature : sdf_signatures())
    EXPECT_TRUE(schema()["$defs"].isMember(std::string("sdf_") + signature.name));
}

}  // namespace
}  // namespace penumbra::test
