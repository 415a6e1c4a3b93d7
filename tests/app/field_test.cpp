// Distance fields as the program meets them.
#include "image/exr.h"
#include "image/png.h"
#include "scene_fixture.h"

namespace penumbra::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kBall = R"({"shape": "sphere", "radius": 1})";
const std::string kTwistedPlane =
    R"({"op": "union", "children": [)" + kBall +
    R"(, {"op": "twist", "rate": 1, "child": {"shape": "plane", "normal": [0, 1, 0], "offset": -2}}]})";

class FieldProgram : public ::testing::Test {
 protected:
  FieldProgram() : scene(folder / "scene.json") {}

  void write(const std::string& root, const std::string& others = "",
             const std::string& camera = R"({"position": [0, 2, 6], "look_at": [0, 0, 0]})") {
    const std::string view = camera.empty() ? "" : R"("camera": )" + camera + ", ";
    write_file(scene, "{" + view + R"("materials": {"m": {"diffuse": [0.5, 0.5, 0.5]}},
      "objects": [)" + others +
                          R"({"type": "sdf", "material": "m", "root": )" + root + R"(}],
      "lights": [{"type": "sphere", "position": [0, 5, 0], "radius": 0.5, "radiance": [9, 9, 9]}]})");
  }
  Outcome render(std::vector<std::string> options = {}) {
    std::vector<std::string> words{"render", scene, "-o", folder / "a.png", "--size", "48x32"};
    words.insert(words.end(), options.begin(), options.end());
    return penumbra(words);
  }
  static int count(const std::string& text, const std::string& part) {
    int n = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
  }
  int brightest() const {
    const Image image = read_png(folder / "a.png");
    float most = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        for (int c = 0; c < 3; ++c) most = std::max(most, image.at(x, y)[c]);
    return static_cast<int>(255 * most);
  }

  TemporaryFolder folder;
  std::string scene;
};

TEST_F(FieldProgram, InfoTellsWarningsByPathAndConversions) {
  write_file(folder / "t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write(kTwistedPlane, R"({"type": "mesh", "file": "t.obj", "material": "m"}, )");
  const Outcome outcome = penumbra({"info", scene});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(count(outcome.out, "warning     the twist at root.children[1] of \"sdf 1\""), 1);
  EXPECT_EQ(count(outcome.out, "has distances by a grid"), 1);
  EXPECT_EQ(count(outcome.out, "becomes triangles only within --bounds"), 1);
}

TEST_F(FieldProgram, RenderTellsWarningsOnce) {
  write(kTwistedPlane);
  for (const char* method : {"hard", "sdf-inner"})
    EXPECT_EQ(count(render({"--shadows", method}).err, "the twist at root.children[1] of"), 1)
        << method;
  write_file(folder / "p.csv", "x,y,z,nx,ny,nz\n0,1,0,0,1,0\n");
  EXPECT_EQ(count(penumbra({"probe", scene, "--points", folder / "p.csv"}).err, "the twist at"), 0)
      << "parker refuses it";
  EXPECT_EQ(count(penumbra({"probe", scene, "--points", folder / "p.csv", "--shadows", "hard"}).err,
                  "the twist at root.children[1] of"),
            1);
}

TEST_F(FieldProgram, FieldsWithoutEndAreNamedWhereTrianglesAreNeeded) {
  write(R"({"op": "onion", "thickness": 0.1, "child": {"op": "repeat", "spacing": [3, 3, 3],
            "child": )" +
        kBall + "}}");
  const Outcome outcome = render({"--shadows", "parker", "-q"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(
      outcome.err,
      "penumbra: " + scene +
          ": the repeat at root.child of \"sdf 0\" has no end, and this method needs triangles "
          "of it; give the box to keep by --bounds x0,y0,z0,x1,y1,z1\n");
  EXPECT_EQ(folder.count(), 1);
  EXPECT_EQ(render({"--shadows", "parker", "-q", "--bounds=-2,-2,-2,2,2,2"}).status, 0);
  EXPECT_EQ(render({"--shadows", "sdf-classic", "-q"}).status, 0);
}

TEST_F(FieldProgram, WithoutACameraWhatHasNoEndIsSeen) {
  write(R"({"shape": "plane", "normal": [0, 1, 0]})", "", "");
  const Outcome outcome = render({"--shadows", "hard"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err, HasSubstr("added a view from"));
  EXPECT_GT(brightest(), 50);
}

TEST_F(FieldProgram, AnEyeInASolidSeesBlackAndIsTold) {
  write(R"({"shape": "sphere", "radius": 100})");
  for (const char* camera :
       {R"({"position": [0, 2, 6], "look_at": [0, 0, 0]})",
        R"({"position": [0, 2, 6], "look_at": [0, 0, 0], "vertical_fov_deg": 90})"}) {
    write(R"({"shape": "sphere", "radius": 100})", "", camera);
    const Outcome outcome = render({"--shadows", "none", "--exposure", "5"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(count(outcome.err, "the camera is inside a solid: the picture is black there"), 1);
    EXPECT_EQ(brightest(), 0);
  }
}

// Slopes of 30,000: more steps than any ray is given, whatever the way.
TEST_F(FieldProgram, RaysThatRunOutOfStepsAreCounted) {
  write(R"({"op": "displace", "amplitude": 0.1, "frequency": 300000, "child":
            {"shape": "box", "center": [0, 3, 0], "half_size": [2, 0.1, 2]}})",
        R"({"type": "quad", "corner": [-2, 0, 2], "edge_u": [4, 0, 0], "edge_v": [0, 0, -4],
            "material": "m"}, )");
  for (const char* method : {"hard", "area"}) {
    const Outcome outcome = render({"--shadows", method, "--spp", "1", "--size", "16x12",
                                    "--light-samples", "2", "--stats", folder / "s.json"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(count(outcome.err, "shadow rays ran out of steps in a distance field"), 1)
        << outcome.err;
    EXPECT_THAT(read_file(folder / "s.json"), HasSubstr("\"shadow_unfinished\" : "));
    EXPECT_EQ(count(read_file(folder / "s.json"), "\"shadow_unfinished\" : 0"), 0);
  }
}

TEST_F(FieldProgram, MeshesWithHolesCastEveryShadow) {
  write_file(folder / "open.obj",
             "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 1.5 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\n");
  write(kBall, R"({"type": "mesh", "file": "open.obj", "material": "m"}, )");
  for (const char* method : {"hard", "area", "parker", "sdf-classic", "sdf-improved", "sdf-inner"})
    EXPECT_EQ(render({"--shadows", method, "-q", "--spp", "1"}).status, 0) << method;
}

TEST_F(FieldProgram, ThousandLevelsAndHundredThousandNodesRender) {
  std::string root = kBall;
  for (int i = 0; i < 1000; ++i)
    root = R"({"op": "translate", "offset": [0.001, 0, 0], "child": )" + root + "}";
  write(root);
  EXPECT_EQ(render({"--shadows", "sdf-inner", "-q"}).status, 0);
  root = R"({"op": "union", "children": [)";
  for (int i = 0; i < 100000; ++i)
    root += std::string(i ? "," : "") + R"({"shape": "sphere", "radius": 0.002, "center": [)" +
            std::to_string(i % 300) + "e-2, 0, -" + std::to_string(i / 300) + "e-2]}";
  write(root + "]}");
  EXPECT_EQ(render({"--shadows", "hard", "-q", "--spp", "1"}).status, 0);
}

TEST_F(FieldProgram, ShadersNeedAMapOrAPicture) {
  write_file(folder / "s.glsl", "float distance_to_all(vec3 p) { return p.y; }\n");
  const Outcome outcome = penumbra({"render", folder / "s.glsl", "-o", folder / "a.png"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err,
              StartsWith("penumbra: " + folder / "s.glsl" +
                         ": the shader has no map and no mainImage; give it a float map(vec3 p)"));
  EXPECT_EQ(folder.count(), 1);
}

// Each of these renders or is refused; none may hang or die.
TEST_F(FieldProgram, OddTreesAreHarmless) {
  const auto about = [](const std::string& op, const std::string& child = kBall) {
    return "{" + op + R"(, "child": )" + child + "}";
  };
  std::string nested = kBall;
  for (const char* spacing : {"3", "30", "300", "3000"})
    nested = about(R"("op": "repeat", "limit": [2, 2, 2], "spacing": [)" + std::string(spacing) +
                       ", 3, " + spacing + "]",
                   nested);
  const std::vector<std::string> roots{
      R"({"op": "smooth_union", "k": 1e9, "children": [)" + kBall + ", " + kBall + "]}",
      R"({"shape": "sphere", "radius": 1e9})",
      R"({"shape": "sphere", "radius": 1e-12})",
      R"({"shape": "sphere", "center": [1e9, -1e9, 1e9], "radius": 1})",
      about(R"("op": "repeat", "spacing": [0, 0, 0])"),
      about(R"("op": "repeat", "spacing": [1e-9, 0, 0])"),
      about(R"("op": "repeat", "spacing": [3, 3, 3], "limit": [1000000, 1000000, 1000000])"),
      about(R"("op": "displace", "amplitude": 0.3, "frequency": 1e9)"),
      about(R"("op": "displace", "amplitude": 1e9, "frequency": 1e-9)"),
      about(R"("op": "scale", "factor": 1e-12)"),
      about(R"("op": "scale", "factor": [1e9, 1e-12, 1])"),
      about(R"("op": "onion", "thickness": 1e9)"),
      about(R"("op": "twist", "rate": 1e9)"),
      about(R"("op": "bend", "rate": -1e9)"),
      nested};
  for (const std::string& root : roots) {
    write(root);
    for (const char* method : {"hard", "sdf-inner"})
      EXPECT_EQ(render({"--shadows", method, "-q", "--spp", "1", "--size", "24x16"}).status, 0)
          << root;
  }
  for (const char* root :
       {"[]", "[[]]", "null", "3", R"({"op": "union", "children": {}})",
        R"({"op": "union", "children": [[]]})", R"({"op": "onion", "thickness": [1], "child": {}})",
        R"({"op": ["union"], "children": []})", R"({"shape": {"shape": "sphere"}})",
        R"({"shape": "sphere", "radius": 1e30})", R"({"shape": "sphere", "radius": [1]})",
        R"({"op": "repeat", "spacing": [-1, 0, 0], "child": {"shape": "sphere", "radius": 1}})"}) {
    write(root);
    const Outcome outcome = render({"-q"});
    EXPECT_EQ(outcome.status, 2) << root;
    EXPECT_EQ(count(outcome.err, "\n"), 1) << outcome.err;
    EXPECT_THAT(outcome.err, StartsWith("penumbra: " + scene + ":")) << root;
    EXPECT_THAT(outcome.err, HasSubstr("root")) << outcome.err;
  }
}

}  // namespace
}  // namespace penumbra::test
