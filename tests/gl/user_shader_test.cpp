#include "render/glsl/user_shader.h"

#include <gmock/gmock.h>

#include "base/error.h"

namespace penumbra {
namespace {

std::string refusal(const std::string& text) {
  try {
    read_user_shader("a.glsl", text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(UserShader, FindsWhatItHas) {
  const UserShader s = read_user_shader(
      "a.glsl",
      "#define TWO 2.0\n# define f(x) \\\n  (x)\n/* void mainImage( */ // vec3 albedo(\n"
      "float  map ( in vec3 p ) { return f(TWO); }\n");
  EXPECT_TRUE(s.has_map);
  EXPECT_FALSE(s.has_albedo);
  EXPECT_FALSE(s.has_main_image);
  EXPECT_THAT(s.macros, ::testing::ElementsAre("TWO", "f"));
}

TEST(UserShader, KeepsLines) {
  const std::string text =
      "#version 300 es\n/* two\nlines */ uniform float iTime; uniform highp vec3 iResolution;\n"
      "float map(vec3 p) { return p.y; }\nuniform float mine;\nvoid main() {}\n"
      "float penumbra_x = gl_FragCoord.x;\n";
  const UserShader s = read_user_shader("a.glsl", text);
  EXPECT_EQ(std::count(s.code.begin(), s.code.end(), '\n'),
            std::count(text.begin(), text.end(), '\n'));
  for (const char* gone : {"version", "two", "iTime", "iResolution", "void main(", "gl_FragCoord"})
    EXPECT_THAT(s.code, ::testing::Not(::testing::HasSubstr(gone)));
  for (const char* kept :
       {"uniform float mine;", "user_main", "user_penumbra_x", "pnb_FragCoord.x"})
    EXPECT_THAT(s.code, ::testing::HasSubstr(kept));
}

TEST(UserShader, RefusesWhatCannotBeRendered) {
  EXPECT_THAT(refusal("float distance(vec3 p) { return p.y; }"),
              ::testing::StartsWith("a.glsl: the shader has neither map nor mainImage; "));
  EXPECT_THAT(refusal("\nvec2 map(vec3 p) { return p.xy; }"),
              ::testing::StartsWith("a.glsl:2: map returns vec2; "));
  EXPECT_THAT(refusal("// float map(vec3 p)"),
              ::testing::StartsWith("a.glsl: the shader has neither map nor mainImage; "));
  EXPECT_THAT(refusal(""), ::testing::StartsWith("a.glsl: "));
}

TEST(UserShader, TakesAnyBytes) {
  std::string text = "float map(vec3 p){return p.y;}";
  for (int i = 0; i < 256; ++i) text += static_cast<char>(i);
  text += "/*";
  EXPECT_TRUE(read_user_shader("a.glsl", text).has_map);
  EXPECT_TRUE(read_user_shader("a.glsl", std::string(2'000'000, 'a') + " float map(").has_map);
}

}  // namespace
}  // namespace penumbra
