// docs/scene-format.md: its examples are read, and it names every key.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/reader.h>

#include <sstream>

#include "json_support.h"
#include "scene/sdf_schema.h"
#include "scene/starter.h"

namespace penumbra::test {
namespace {

std::string manual() { return read_file(PENUMBRA_SOURCE_DIR "/docs/scene-format.md"); }

std::vector<std::string> examples() {
  const std::string text = manual(), fence = "```jsonc\n";
  std::vector<std::string> blocks;
  for (std::size_t at = 0; (at = text.find(fence, at)) != std::string::npos;) {
    at += fence.size();
    const std::size_t end = text.find("```", at);
    blocks.push_back(text.substr(at, end - at));
    at = end + 3;
  }
  return blocks;
}

// An example is a whole scene, an object, or a member of the scene.
std::string whole(const std::string& example) {
  constexpr const char* materials = R"("materials": {"floor": {}, "chrome": {}, "glaze": {}})";
  if (example.starts_with("{\n")) return example;
  if (example.starts_with("{\"type\""))
    return std::string("{").append(materials).append(", \"objects\": [").append(example) + "]}";
  return std::string("{\"objects\": [], ").append(example) + "}";
}

void collect_keys(const Json::Value& value, std::vector<std::string>& keys) {
  if (!value.isObject()) return;
  for (const std::string& name : value.getMemberNames()) {
    if (name == "properties")
      for (const std::string& key : value[name].getMemberNames()) keys.push_back(key);
    collect_keys(value[name], keys);
  }
}

TEST(JsonDocs, ExamplesAreRead) {
  write_file(scratch().file("bunny.obj"), "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
  write_file(scratch().file("planks.jpg"), "no picture");
  write_file(scratch().file("blobs.glsl"), "float map(vec3 p) { return length(p) - 1.0; }");
  ASSERT_GE(examples().size(), 9u);
  for (const std::string& example : examples())
    EXPECT_EQ(error_of(whole(example)), "(no error)") << example;
}

TEST(JsonDocs, TablesOfDistanceFields) {
  const std::string docs = manual();
  for (const SdfKind kind : {SdfKind::shape, SdfKind::operation, SdfKind::transform})
    EXPECT_THAT(docs, testing::HasSubstr(sdf_manual_rows(kind)));
}

TEST(JsonDocs, NameEveryKey) {
  Json::Value schema;
  std::istringstream text{std::string(scene_schema())};
  text >> schema;
  std::vector<std::string> keys;
  collect_keys(schema, keys);
  ASSERT_GT(keys.size(), 40u);
  const std::string docs = manual();
  for (const std::string& key : keys)
    EXPECT_THAT(docs, testing::HasSubstr(std::string("`").append(key).append("`")));
}

}  // namespace
}  // namespace penumbra::test
