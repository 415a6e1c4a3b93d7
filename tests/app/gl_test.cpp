#include "base/atomic_file.h"
#include "image/exr.h"
#include "image/png.h"
#include "scene_fixture.h"

namespace penumbra::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class GlProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    write_file(folder / "any.glsl", "float map(vec3 p) { return p.y; }\n");
    const Outcome outcome = penumbra(
        {"render", folder / "any.glsl", "-o", folder / "any.png", "--size", "8x8", "--quiet"});
    if (outcome.status == 1 && outcome.err.find("no OpenGL driver") != std::string::npos)
      GTEST_SKIP() << outcome.err;
  }

  Outcome render(const std::string& shader, std::vector<std::string> options = {}) {
    write_file(folder / "s.glsl", shader);
    std::vector<std::string> words{"render", folder / "s.glsl", "-o", folder / "s.png",
                                   "--size", "32x24",           "-q"};
    words.insert(words.end(), options.begin(), options.end());
    return penumbra(words);
  }
  std::string picture() const { return read_file(folder / "s.png"); }

  TemporaryFolder folder;
};

const std::string kBlob =
    "#define t 0.4\nfloat blob(vec3 p) { return length(p - vec3(0, 0.5 + t * sin(iTime), 0)) - t; "
    "}\n"
    "float map(vec3 p) { return min(p.y, blob(p)); }\n";

TEST_F(GlProgram, EveryMethodRendersAMap) {
  std::vector<std::string> pictures;
  for (const char* method : {"none", "hard", "area", "sdf-classic", "sdf-improved", "sdf-inner"}) {
    const Outcome outcome = render(kBlob, {"--shadows", method});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    for (const std::string& other : pictures) EXPECT_NE(picture(), other) << method;
    pictures.push_back(picture());
  }
}

TEST_F(GlProgram, TimeMoves) {
  EXPECT_EQ(render(kBlob).status, 0);
  const std::string still = picture();
  EXPECT_EQ(render(kBlob, {"--time", "1"}).status, 0);
  EXPECT_NE(picture(), still);
}

TEST_F(GlProgram, SceneFilesNameShaders) {
  write_file(folder / "s.glsl", kBlob);
  const std::string scene = folder / "scene.json";
  write_file(scene, R"({"camera": {"position": [0, 2, 4], "look_at": [0, 0, 0]},
    "objects": [{"type": "glsl", "file": "s.glsl"},
                {"type": "sphere", "center": [1, 0.5, 0], "radius": 0.5, "material": "m"}],
    "materials": {"m": {"diffuse": [0.9, 0.1, 0.1]}},
    "lights": [{"type": "sphere", "position": [2, 4, 1], "radius": 0.3, "radiance": [20, 20, 20]}]})");
  const Outcome outcome =
      penumbra({"render", scene, "-o", folder / "a.png", "--size", "32x24", "-q"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST_F(GlProgram, ErrorsNameThePersonsLine) {
  const Outcome outcome =
      render("float map(vec3 p) {\n  return p.y;\n}\nfloat g() { return x1; }\n");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, StartsWith("penumbra: " + folder / "s.glsl" + ":4:"));
  EXPECT_THAT(outcome.err, HasSubstr("correct the shader"));
  const Outcome parameters = render("float map(vec2 p) { return p.y; }\n");
  EXPECT_EQ(parameters.status, 2);
  EXPECT_THAT(parameters.err, StartsWith("penumbra: " + folder / "s.glsl" + ": "));
  EXPECT_THAT(parameters.err, HasSubstr("float map(vec3 p)"));
}

TEST_F(GlProgram, LoopsWithoutEndAreStoppedAndTold) {
  for (const char* shader :
       {"float map(vec3 p) { float s = p.y; for (;;) { s += 0.1; if (s < -9.0) break; } return s; "
        "}\n",
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(0); for (;;) c.x += 1e-9 * p.x;\n}\n"}) {
    const Outcome outcome = render(shader);
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("loop"));
    EXPECT_EQ(folder.count(), 3);
  }
}

TEST_F(GlProgram, EyeInASolidIsTold) {
  const Outcome outcome = render("float map(vec3 p) { return length(p) - 100.0; }\n");
  EXPECT_EQ(outcome.status, 0);
  write_file(folder / "in.glsl", "float map(vec3 p) { return length(p) - 100.0; }\n");
  const Outcome told = penumbra(
      {"render", folder / "in.glsl", "-o", folder / "in.png", "--size", "8x8", "--exposure", "0"});
  EXPECT_THAT(told.err, HasSubstr("the camera is inside a solid"));
  const Image image = read_png(folder / "in.png");
  EXPECT_EQ(image.at(4, 4)[0], 0);
}

TEST_F(GlProgram, StepsAreALayerToo) {
  const std::string steps = "steps=" + folder / "steps.exr";
  EXPECT_EQ(render(kBlob, {"--shadows", "sdf-classic", "--aov", steps}).status, 0);
  const ExrFile file = read_exr(folder / "steps.exr");
  ASSERT_EQ(file.channels.count("steps.Y"), 1u);
  const std::vector<float>& counts = file.channels.at("steps.Y").data;
  EXPECT_GT(*std::max_element(counts.begin(), counts.end()), 3);
  const Outcome outcome = render("void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n",
                                 {"--shadows", "sdf-classic", "--aov", steps});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("a mainImage does not march"));
}

TEST_F(GlProgram, ProbeTakesTheMap) {
  write_file(folder / "s.glsl", kBlob);
  write_file(folder / "p.csv", "x,y,z,nx,ny,nz\n0,0,0,0,1,0\n9,0,9,0,1,0\n");
  const Outcome outcome =
      penumbra({"probe", folder / "s.glsl", "--points", folder / "p.csv", "--shadows", "sdf-inner",
                "--device", "gl", "-q", "--no-scene-lights", "--light", "sphere:0,5,0,0.2,1"});
  EXPECT_EQ(outcome.out,
            "x,y,z,nx,ny,nz,visible_fraction\n0,0,0,0,1,0,0.000000\n9,0,9,0,1,0,1.000000\n")
      << outcome.err;
}

TEST_F(GlProgram, ExportIsAShaderThatRenders) {
  write_file(folder / "s.glsl", kBlob);
  const Outcome outcome = penumbra({"export", folder / "s.glsl", "-o", folder / "out.glsl",
                                    "--shadows", "sdf-classic", "--exposure", "0.5"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(
      penumbra({"render", folder / "out.glsl", "-o", folder / "out.png", "--size", "32x24", "-q"})
          .status,
      0);
  EXPECT_EQ(penumbra({"export", folder / "s.glsl", "-o", folder / "out.txt"}).status, 2);
}

TEST_F(GlProgram, ExportSaysWhyItTakesNoMesh) {
  write_file(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Outcome outcome = penumbra({"export", folder / "a.obj", "-o", folder / "out.glsl", "-q"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("which Shadertoy does not take; draw the scene by penumbra "
                                     "render --device gl"));
}

TEST_F(GlProgram, SaysSoWhereThereIsNoDriver) {
  const Outcome outcome =
      penumbra({"render", folder / "any.glsl", "-o", folder / "a.png", "-q"},
               [] { ::setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", 1); });
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, StartsWith("penumbra: there is no OpenGL driver that draws without a "
                                      "display"));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
}

TEST_F(GlProgram, ShadersAreNotForTheProcessor) {
  const Outcome outcome = render(kBlob, {"--device", "cpu"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("shaders are drawn by OpenGL alone"));
  EXPECT_EQ(render(kBlob, {"--shadows", "parker"}).status, 2);
}

}  // namespace
}  // namespace penumbra::test
