// docs/distance-fields.md shows every shape, profile, operator and transform that can be read.
#include <gtest/gtest.h>

#include <filesystem>

#include "json_support.h"
#include "scene/sdf.h"

namespace penumbra::test {
namespace {

// What stands below the heading, up to the next.
std::string section(const std::string& heading) {
  const std::string page = read_file(PENUMBRA_SOURCE_DIR "/docs/distance-fields.md");
  const std::string line = "\n### " + heading + "\n";
  const std::size_t start = page.find(line);
  if (start == page.npos) return "";
  return page.substr(start + line.size(), page.find("\n#", start + 1) - start - line.size());
}

std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t found = text.find(from), start = found + from.size();
  return found == text.npos ? "" : text.substr(start, text.find(to, start) - start);
}

void expect_shown(const std::string& heading, const std::string& picture, const std::string& uses) {
  const std::string text = section(heading);
  ASSERT_NE(text, "") << "docs/distance-fields.md has no heading " << heading;
  EXPECT_EQ(between(text, "](images/", ")"), picture) << heading;
  EXPECT_TRUE(std::filesystem::exists(PENUMBRA_SOURCE_DIR "/docs/images/" + picture))
      << picture << ": run scripts/field-pictures";
  const std::string root = between(text, "```jsonc\n", "```");
  EXPECT_NE(root.find(uses), root.npos) << heading << " has no " << uses;
  EXPECT_EQ(error_of(R"({"materials": {"red": {}, "blue": {}}, "objects": [
                         {"type": "sdf", "material": "red", "root": )" +
                     root + "}]}"),
            "(no error)")
      << heading;
}

TEST(SdfPictures, EverySignatureIsShown) {
  for (const SdfSignature& signature : sdf_signatures()) {
    const std::string name(signature.name);
    const char* kind = signature.kind == SdfKind::shape ? "shape" : "op";
    expect_shown("`" + name + "`", "field-" + name + ".png",
                 std::string("\"").append(kind).append("\": \"").append(name).append("\""));
  }
}

TEST(SdfPictures, EveryProfileIsShown) {
  for (const std::string name : {"circle", "box", "polygon"})
    expect_shown("Profile `" + name + "`", "field-profile-" + name + ".png",
                 "\"profile\": {\"shape\": \"" + name + "\"");
}

}  // namespace
}  // namespace penumbra::test
