#include "gl/program.h"

#include "gl/driver.h"
#include "gl/target.h"

namespace penumbra::gl {
namespace {

class ProgramTest : public testing::GlTest {};

const std::string kHead =
    "#version 300 es\nprecision highp float;\nlayout(location = 0) out vec4 a;\n"
    "layout(location = 1) out vec4 b;\nuniform float x;\nuniform vec4 list[2];\n"
    "uniform highp sampler2D t;\n";

TEST_F(ProgramTest, DrawsFloatsIntoEveryLayer) {
  const std::vector<float> texels = testing::drawn([] {
    Program program(kHead +
                    "void main() { a = vec4(gl_FragCoord.xy, x, list[1].z);\n"
                    "b = texelFetch(t, ivec2(gl_FragCoord.xy), 0) * 1e6; }\n");
    const Target target(5, 4, 2);
    Texture texture(5, 4);
    texture.write(2, 1, std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8});
    texture.bind(1);
    program.set("t", 1);
    program.set("x", -0.125f);
    program.set_vec4s("list", std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8});
    target.use();
    program.draw(2, 1);
    std::vector<float> all = target.read(0, 2, 1);
    for (const float v : target.read(1, 2, 1)) all.push_back(v);
    return all;
  });
  EXPECT_EQ(texels, (std::vector<float>{0.5f, 0.5f, -0.125f, 7, 1.5f, 0.5f, -0.125f, 7, 1e6f, 2e6f,
                                        3e6f, 4e6f, 5e6f, 6e6f, 7e6f, 8e6f}));
}

TEST_F(ProgramTest, CompileErrorsCarryTheLine) {
  const std::vector<float> place = testing::drawn([]() -> std::vector<float> {
    try {
      Program(kHead + "#line 10 3\nvoid main() {\n  a = nothing;\n}\n");
    } catch (const CompileError& error) {
      for (const CompileMessage& m : error.messages())
        if (m.error) return {float(m.line)};
    }
    return {};
  });
  EXPECT_EQ(place, (std::vector<float>{11}));
}

}  // namespace
}  // namespace penumbra::gl
