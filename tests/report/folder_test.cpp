#include "report/folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "report/deflate.h"
#include "support/temporary_folder.h"

namespace penumbra::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  std::uint32_t word = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    word = word << 6 | static_cast<std::uint32_t>(digits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    out += static_cast<char>(word >> bits & 255);
  }
  return out;
}

TEST(Folder, DataScriptsHoldPlanesOfBytes) {
  // Base64 ends in three ways, by the length of what it says.
  for (int width = 1; width < 40; ++width) {
    Fractions fractions(2, Image(width, 1, 1));
    for (int x = 0; x < width; ++x)
      fractions[1].data[static_cast<std::size_t>(x)] = static_cast<float>(x % 9) / 8;
    fractions[0].data[0] = NAN;
    const std::string script = data_script("hard", fractions);
    const std::string begin = "\"values\":\"";
    const std::size_t at = script.find(begin) + begin.size();
    const std::string bytes = *inflated(from_base64(script.substr(at, script.find('"', at) - at)),
                                        static_cast<std::size_t>(2 * width));
    EXPECT_EQ(static_cast<unsigned char>(bytes[0]), 255);
    for (int x = 0; x < width; ++x)
      ASSERT_EQ(static_cast<unsigned char>(bytes[static_cast<std::size_t>(width + x)]),
                std::lround(254 * static_cast<float>(x % 9) / 8));
    EXPECT_THAT(script, HasSubstr("penumbraData(\"hard\", {\"width\":" + std::to_string(width) +
                                  ",\"height\":1,\"lights\":2,\"bits\":8,"
                                  "\"encoding\":\"deflate\","));
  }
}

TEST(Folder, NothingInTheResultsEndsThePagesScript) {
  const std::string page = page_with("{\"file\": \"</script><b>.json\"}");
  EXPECT_THAT(page, HasSubstr("{\"file\": \"\\u003c/script>\\u003cb>.json\"}"));
  EXPECT_THAT(page, Not(HasSubstr("@results@")));
}

TEST(Folder, GrayIsInProportionToTheMeanFraction) {
  Fractions fractions(2, Image(2, 1, 1));
  fractions[0].data = {1, NAN};
  fractions[1].data = {0.5f, NAN};
  const Image gray = gray_of(fractions);
  EXPECT_NEAR(gray.data[0], 0.5225, 0.0005);  // of the code 0.75
  EXPECT_EQ(gray.data[0], gray.data[2]);
  EXPECT_GT(gray.data[5], gray.data[3]);  // slate
}

TEST(Folder, IsMadeWithItsParts) {
  const test::TemporaryFolder folder;
  prepare_folder(folder / "a/b");
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a/b/pictures"));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "a/b/data"));
}

}  // namespace
}  // namespace penumbra::report
