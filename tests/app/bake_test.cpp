#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "image/exr.h"
#include "image/png.h"
#include "scene_fixture.h"

namespace penumbra::test {
namespace {

namespace fs = std::filesystem;

/// Where scripts/get-viewer puts npm's packages.
const std::string npm = PENUMBRA_SOURCE_DIR "/build/npm";

class BakeCommandTest : public SceneTest {
 protected:
  BakeCommandTest() {
    write_file(scene, R"({
      "camera": {"position": [0.3, 1.6, 5.2], "look_at": [0, 0.9, 0]},
      "materials": {"grey": {"diffuse": [0.6, 0.6, 0.6]}, "red": {"diffuse": [0.7, 0.2, 0.1]}},
      "objects": [
        {"type": "quad", "name": "floor", "corner": [-3, 0, 3], "edge_u": [6, 0, 0],
         "edge_v": [0, 0, -6], "material": "grey"},
        {"type": "quad", "corner": [-3, 0, -3], "edge_u": [6, 0, 0], "edge_v": [0, 3, 0],
         "material": "red"},
        {"type": "box", "min": [0.5, 0, -1], "max": [1.5, 1.2, 0], "material": "red"},
        {"type": "sphere", "center": [-0.8, 0.6, 0], "radius": 0.6, "material": "grey"},
        {"type": "polygon", "vertices": [[-2.5, 0.3, 2], [-1, 0.3, 2], [-1, 0.3, 1.6],
         [-2.1, 0.3, 1.6], [-2.1, 0.3, 0.8], [-2.5, 0.3, 0.8]], "material": "red",
         "receives": false}],
      "lights": [{"type": "rect", "corner": [-0.5, 2.8, 0.5], "edge_u": [0, 0, -1],
                  "edge_v": [1, 0, 0], "radiance": [9, 9, 9]}],
      "background": [0.02, 0.03, 0.05]})");
  }

  Outcome bake(std::vector<std::string> options, const std::string& output) {
    std::vector<std::string> words{"bake", scene, "-o", output, "--light-samples", "64"};
    words.insert(words.end(), options.begin(), options.end());
    return penumbra(words);
  }
  Outcome render(const std::string& file, const std::string& output, const char* method) {
    return penumbra({"render", file, "-o", output, "--shadows", method, "--size", "160x90", "-q"});
  }
};

bool has_viewer() {
  const fs::path top = fs::path(PENUMBRA_PROGRAM).parent_path().parent_path();
  return fs::exists(top / "share/penumbra/viewer/three.module.js");
}

/// Part of the pixels that differ by more than 0.03 in linear light.
double differing(const Image& a, const Image& b) {
  std::size_t count = 0, pixels = a.data.size() / 4;
  for (std::size_t i = 0; i < pixels; ++i) {
    bool differs = false;
    for (std::size_t c = 0; c < 3; ++c)
      differs |= std::abs(a.data[4 * i + c] - b.data[4 * i + c]) > 0.03f;
    count += differs;
  }
  return static_cast<double>(count) / static_cast<double>(pixels);
}

TEST_F(BakeCommandTest, TheBakedFileLooksLikeTheScene) {
  const std::string baked = folder / "baked.glb";
  ASSERT_EQ(bake({"--texel-size", "0.03", "-q"}, baked).status, 0);
  ASSERT_EQ(render(scene, folder / "a.png", "area").status, 0);
  ASSERT_EQ(render(baked, folder / "b.png", "none").status, 0);
  // The polygon's unshadowed light and the silhouette of the ball may differ.
  EXPECT_LT(differing(read_png(folder / "a.png"), read_png(folder / "b.png")), 0.02);
}

TEST_F(BakeCommandTest, TellsWhatItDid) {
  const Outcome outcome =
      bake({"--texel-size", "0.1", "--stats", folder / "s.json"}, folder / "b.glb");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* line : {"load: ", "\nbake: ", " texels of 0.1 m, 1 texture\n",
                           "became vertex colours", "MB of texels saved\n", "exposure: "})
    EXPECT_THAT(outcome.err, ::testing::HasSubstr(line));
  EXPECT_THAT(read_file(folder / "s.json"), ::testing::HasSubstr("\"vertex_charts\""));
}

TEST_F(BakeCommandTest, HdrIsLinearRadianceBeside) {
  ASSERT_EQ(bake({"--texel-size", "0.1", "--hdr", "-q"}, folder / "b.glb").status, 0);
  EXPECT_EQ(read_exr(folder / "b.exr").channels.count("G"), 1u);
  EXPECT_EQ(folder.count(), 3);
}

TEST_F(BakeCommandTest, OpenGlBakesTheSame) {
  const Outcome outcome =
      bake({"--texel-size", "0.05", "--hdr", "--device", "gl", "-q"}, folder / "gl.glb");
  if (outcome.status == 1 && outcome.err.find("no OpenGL driver") != std::string::npos)
    GTEST_SKIP() << "no OpenGL 4.5 driver that draws without a display";
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  ASSERT_EQ(
      bake({"--texel-size", "0.05", "--hdr", "--device", "cpu", "-q"}, folder / "cpu.glb").status,
      0);
  const std::vector<float> gl = read_exr(folder / "gl.exr").channels.at("G").data;
  const std::vector<float> cpu = read_exr(folder / "cpu.exr").channels.at("G").data;
  ASSERT_EQ(gl.size(), cpu.size());
  std::size_t differ = 0;
  for (std::size_t i = 0; i < gl.size(); ++i)
    differ += std::abs(gl[i] - cpu[i]) > 1e-3f * std::max(cpu[i], 0.01f);
  EXPECT_LT(differ, gl.size() / 20);
}

TEST_F(BakeCommandTest, SaysSoWhereThereIsNoDriver) {
  const Outcome outcome =
      penumbra({"bake", scene, "-o", folder / "b.glb", "--device", "gl", "-q"},
               [] { ::setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", 1); });
  expect_refused(outcome, 1,
                 "there is no OpenGL driver that draws without a display (EGL, OpenGL 4.5); "
                 "install one (Mesa's: apt-get install libegl1 libgl1-mesa-dri) or leave out "
                 "--device gl");
  EXPECT_EQ(folder.count(), 1);
}

TEST_F(BakeCommandTest, ALightmapHasItsExrAndJsonBeside) {
  const Outcome outcome = bake({"--texel-size", "0.1", "--lightmap", "-q"}, folder / "b.glb");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(read_exr(folder / "b.exr").channels.count("R"), 1u);
  const std::string json = read_file(folder / "b.json");
  for (const char* text : {"\"exr\" : \"b.exr\"", "\"glb\" : \"b.glb\"", "\"mesh\" : \"floor\"",
                           "\"texCoord\" : 1", "W/m²"})
    EXPECT_THAT(json, ::testing::HasSubstr(text));
}

TEST_F(BakeCommandTest, TheKhronosValidatorFindsNoError) {
  if (std::system("node --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "there is no node";
  if (!fs::exists(npm + "/node_modules/gltf-validator"))
    GTEST_SKIP() << "gltf-validator is not there; run scripts/get-viewer";
  ASSERT_EQ(bake({"--texel-size", "0.1", "-q"}, folder / "r.glb").status, 0);
  ASSERT_EQ(bake({"--texel-size", "0.1", "--lightmap", "-q"}, folder / "l.glb").status, 0);
  std::vector<const char*> names{"r.glb", "l.glb"};
  // Normal, occlusion and emission maps.
  const std::string helmet = PENUMBRA_SHARED_DIR "/models/DamagedHelmet.glb";
  if (fs::exists(helmet)) {
    ASSERT_EQ(penumbra({"bake", helmet, "-o", folder / "h.glb", "--lightmap", "--texel-size",
                        "0.05", "--light-samples", "4", "-q"})
                  .status,
              0);
    EXPECT_THAT(read_file(folder / "h.glb"), ::testing::HasSubstr("\"normalTexture\""));
    names.push_back("h.glb");
  }
  const std::string script = PENUMBRA_SOURCE_DIR "/tests/app/validate.js";
  for (const char* name : names)
    EXPECT_EQ(
        std::system(
            ("NODE_PATH=" + npm + "/node_modules node " + script + " " + folder / name).c_str()),
        0)
        << name;
}

TEST_F(BakeCommandTest, AnExistingLayoutIsTakenOrRefusedByName) {
  const Outcome outcome =
      bake({"--uv", "existing", "--receivers", "floor", "-q"}, folder / "b.glb");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const Outcome refused = bake({"--uv", "existing", "-q"}, folder / "c.glb");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, ::testing::StartsWith("penumbra: --uv existing: '"));
  EXPECT_THAT(refused.err, ::testing::HasSubstr("; lay it out without overlap in [0, 1]"));
  expect_refused(bake({"--uv", "exist"}, folder / "c.glb"), 2,
                 "--uv: 'exist' is unknown; did you mean existing? There are unwrap or existing");
  expect_refused(bake({"--curved", "plan"}, folder / "c.glb"), 2,
                 "--curved: 'plan' is unknown; did you mean plane? There are rays or plane");
}

TEST_F(BakeCommandTest, CurvedSurfacesMayBeShadowedOnAPlane) {
  const std::string window = PENUMBRA_SOURCE_DIR "/scenes/window.json";
  for (const char* way : {"rays", "plane"})
    ASSERT_EQ(penumbra({"bake", window, "-o", folder / way + ".glb", "--receivers", "vase",
                        "--texel-size", "0.02", "--light-samples", "16", "--exposure", "-1",
                        "--curved", way, "-q"})
                  .status,
              0);
  EXPECT_TRUE(read_file(folder / "rays.glb") != read_file(folder / "plane.glb"));
  ASSERT_EQ(render(folder / "rays.glb", folder / "r.png", "none").status, 0);
  ASSERT_EQ(render(folder / "plane.glb", folder / "p.png", "none").status, 0);
  EXPECT_LT(differing(read_png(folder / "r.png"), read_png(folder / "p.png")), 0.05);
}

TEST_F(BakeCommandTest, AStainedGlassWindowLooksAsByAreaLight) {
  const std::string window = PENUMBRA_SOURCE_DIR "/scenes/window.json";
  const auto picture = [&](const std::string& file, const std::string& out,
                           const std::vector<std::string>& options) {
    std::vector<std::string> words{"render",  file, "-o",         folder / out, "--size",
                                   "160x120", "-q", "--exposure", "-1.5"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = penumbra(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return read_png(folder / out);
  };
  const Image area =
      picture(window, "area.png", {"--shadows", "area", "--light-samples", "256", "--spp", "1"});
  const Outcome baked = penumbra({"bake", window, "-o", folder / "w.glb", "--light-samples", "256",
                                  "--texel-size", "0.02", "--exposure", "-1.5", "-q"});
  ASSERT_EQ(baked.status, 0) << baked.err;
  const Image shown = picture(folder / "w.glb", "baked.png", {"--shadows", "none", "--spp", "1"});
  // Edges, of the panes above all, are smoothed by one of the two alone.
  EXPECT_LT(differing(area, shown), 0.1);
  // It is colours that fall on the floor: pixels of saturated red and of blue.
  std::size_t red = 0, blue = 0;
  for (std::size_t i = 0; i < shown.data.size(); i += 4) {
    red += shown.data[i] > 0.1f && shown.data[i] > 1.5f * shown.data[i + 2];
    blue += shown.data[i + 2] > 0.1f && shown.data[i + 2] > 1.5f * shown.data[i];
  }
  EXPECT_GT(red, 200u);
  EXPECT_GT(blue, 20u);
}

TEST_F(BakeCommandTest, ThePreviewHasAllThatItNeeds) {
  if (!has_viewer()) GTEST_SKIP() << "three.js is not there; run scripts/get-viewer";
  ASSERT_EQ(
      bake({"--texel-size", "0.1", "--preview", folder / "p.html", "-q"}, folder / "b.glb").status,
      0);
  const std::string page = read_file(folder / "p.html");
  EXPECT_THAT(page, ::testing::Not(::testing::HasSubstr("src=")));
  for (const char* placeholder : {"@title@", "@imports@", "@glb@"})
    EXPECT_THAT(page, ::testing::Not(::testing::HasSubstr(placeholder)));
  EXPECT_GT(page.size(), read_file(folder / "b.glb").size() * 4 / 3);
}

TEST_F(BakeCommandTest, ThreeJsShowsWhatRenderShows) {
  if (!has_viewer()) GTEST_SKIP() << "three.js is not there; run scripts/get-viewer";
  if (std::system("chromium --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "there is no chromium";
  ASSERT_EQ(
      bake({"--texel-size", "0.03", "--preview", folder / "p.html", "-q"}, folder / "b.glb").status,
      0);
  ASSERT_EQ(std::system(("timeout 60 chromium --headless --no-sandbox --use-gl=angle "
                         "--use-angle=swiftshader --enable-unsafe-swiftshader "
                         "--window-size=960,540 --virtual-time-budget=20000 --user-data-dir=" +
                         folder / "profile" + " --screenshot=" + folder / "shot.png" + " file://" +
                         folder / "p.html" + " > /dev/null 2>&1")
                            .c_str()),
            0);
  ASSERT_EQ(
      penumbra({"render", folder / "b.glb", "-o", folder / "r.png", "--shadows", "none", "-q"})
          .status,
      0);
  // The words on the page, and edges, which are smoothed differently.
  EXPECT_LT(differing(read_png(folder / "shot.png"), read_png(folder / "r.png")), 0.03);
}

TEST_F(BakeCommandTest, APreviewWithoutViewerIsRefusedBeforeTheWork) {
  ::setenv("PENUMBRA_VIEWER", (folder / "nowhere").c_str(), 1);
  const Outcome outcome = bake({"--preview", folder / "p.html"}, folder / "b.glb");
  ::unsetenv("PENUMBRA_VIEWER");
  expect_refused(outcome, 2,
                 folder / "nowhere" +
                     ": the viewer of --preview is not installed: there is no three.module.js; run "
                     "scripts/get-viewer, or let PENUMBRA_VIEWER name its folder");
  EXPECT_EQ(folder.count(), 1);
}

TEST_F(BakeCommandTest, WrongCallsAreRefused) {
  expect_refused(penumbra({"bake", scene}), 2, "no output is named; add -o OUT.glb");
  expect_refused(bake({}, folder / "b.gltf"), 2,
                 folder / "b.gltf" + ": a bake is written as binary glTF; let it end in .glb");
  expect_refused(bake({"--device", "gpu"}, folder / "b.glb"), 2,
                 "--device: 'gpu' is unknown; did you mean cpu? There are auto, cpu, gl or rays");
  expect_refused(bake({"--lightmap", "--hdr"}, folder / "b.glb"), 2,
                 "--hdr: a lightmap always has its EXR beside it; leave --hdr out");
  expect_refused(bake({"--error", "0.01", "--light-samples", "16"}, folder / "b.glb"), 2,
                 "--error: no chart is done before 16 points on each light; give more "
                 "--light-samples");
  expect_refused(bake({"--error", "0.01", "--sample-grid", "regular"}, folder / "b.glb"), 2,
                 "--sample-grid: passes need points that differ, and these lie the same in all; "
                 "leave it out, or --error and --time-limit");
  for (const char* seconds : {"0", "-1", "soon"}) {
    const Outcome wrong = bake({"--time-limit", seconds}, folder / "b.glb");
    EXPECT_EQ(wrong.status, 2);
    EXPECT_THAT(wrong.err, ::testing::StartsWith("penumbra: --time-limit: "));
  }
  const Outcome tight =
      bake({"--texel-size", "0.002", "--max-memory", "40", "-q"}, folder / "b.glb");
  EXPECT_EQ(tight.status, 2);
  EXPECT_THAT(tight.err, ::testing::MatchesRegex(
                             "penumbra: --texel-size: texels of 0.002 m need [0-9]+ MB of memory "
                             "and 40 MB may be taken; give --texel-size [0-9.]+, or more by "
                             "--max-memory\n"));
  EXPECT_EQ(folder.count(), 1);
}

TEST_F(BakeCommandTest, ATimeLimitLeavesAFileWithTheTrueMeanSoFar) {
  const auto mean = [&](const char* name) {
    const ExrFile file = read_exr(folder / name);
    const Image& red = file.channels.at("R");
    double sum = 0;
    for (const float v : red.data) sum += static_cast<double>(v);
    return sum / static_cast<double>(red.data.size());
  };
  const std::vector<std::string> lightmap{"--texel-size", "0.02", "--lightmap"};
  ASSERT_EQ(bake(lightmap, folder / "whole.glb").status, 0);
  std::vector<std::string> limited = lightmap;
  for (const char* word : {"--time-limit", "0.1", "--light-samples", "50000"})
    limited.emplace_back(word);
  const Outcome outcome = bake(limited, folder / "limited.glb");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, ::testing::ContainsRegex("\n[0-9.]+ points a light on average\n"));
  EXPECT_NEAR(mean("limited.exr"), mean("whole.exr"), 0.2 * mean("whole.exr"));
  EXPECT_EQ(render(folder / "limited.glb", folder / "l.png", "none").status, 0);
}

TEST_F(BakeCommandTest, AnErrorEndsEachChartEarly) {
  const std::vector<std::string> words{"--texel-size",    "0.05", "--error", "0.02",
                                       "--light-samples", "4096", "--stats", folder / "s.json"};
  const Outcome outcome = bake(words, folder / "b.glb");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string stats = read_file(folder / "s.json");
  const std::size_t at = stats.find("\"points_per_light\"");
  ASSERT_NE(at, std::string::npos);
  const double points = std::stod(stats.substr(stats.find(':', at) + 1));
  EXPECT_GE(points, 16);
  EXPECT_LT(points, 1024);
}

TEST_F(BakeCommandTest, AnOutputThatCannotBeWrittenIsRefusedBeforeTheWork) {
  fs::create_directory(folder / "b.glb");
  const Outcome outcome = bake({}, folder / "b.glb");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, ::testing::Not(::testing::HasSubstr("bake:")));
}

/// A bake that takes long, once it lights its charts.
class LongBake {
 public:
  LongBake(const std::string& scene, const std::string& output,
           const std::vector<std::string>& more = {})
      : running_(PENUMBRA_PROGRAM, words(scene, output, more)) {
    for (int i = 0; i < 2000 && running_.said().find("build: ") == std::string::npos; ++i)
      ::usleep(10'000);
    ::usleep(700'000);
  }
  void send(int signal) { ::kill(running_.id(), signal); }
  Outcome outcome() { return running_.outcome(); }

 private:
  static std::vector<std::string> words(const std::string& scene, const std::string& output,
                                        const std::vector<std::string>& more) {
    std::vector<std::string> all{
        "bake", scene, "-o", output, "--texel-size", "0.03", "--light-samples", "60000"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Running running_;
};

TEST_F(BakeCommandTest, CtrlCLeavesWhatThereIs) {
  const std::vector<std::vector<std::string>> ways{{}, {"--error", "0.0001"}};
  ASSERT_EQ(render(scene, folder / "truth.png", "area").status, 0);
  const Image truth = read_png(folder / "truth.png");
  for (const auto& way : ways) {
    LongBake bake(scene, folder / "b.glb", way);
    bake.send(SIGINT);
    const Outcome outcome = bake.outcome();
    EXPECT_EQ(outcome.status, 130) << outcome.err;
    EXPECT_THAT(outcome.err, ::testing::HasSubstr("warning: stopped early: "));
    ASSERT_EQ(render(folder / "b.glb", folder / "b.png", "none").status, 0);
    // On a busy machine that is the first pass: hard shadows of one point.
    EXPECT_LT(differing(read_png(folder / "b.png"), truth), 0.4);
    fs::remove(folder / "b.glb"), fs::remove(folder / "b.png");
  }
  EXPECT_EQ(folder.count(), 2);
}

TEST_F(BakeCommandTest, ASecondCtrlCEndsAtOnceAndLeavesNothing) {
  LongBake bake(scene, folder / "b.glb");
  const auto begin = std::chrono::steady_clock::now();
  // Of signals that come while one is pending only one is delivered.
  for (int i = 0; i < 20; ++i) bake.send(SIGINT), ::usleep(5000);
  const Outcome outcome = bake.outcome();
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_LT(waited.count(), 1.5);
  EXPECT_EQ(folder.count(), 1);
}

TEST_F(BakeCommandTest, KilledAtAnyTimeItLeavesTheOldFileOrAWholeNewOne) {
  const std::string output = folder / "b.glb";
  ASSERT_EQ(bake({"--texel-size", "0.05", "-q"}, output).status, 0);
  const std::string whole = read_file(output);
  for (int wait = 0; wait < 400'000; wait += 25'000) {
    write_file(output, "the old one");
    Running running(PENUMBRA_PROGRAM, {"bake", scene, "-o", output, "--light-samples", "64",
                                       "--texel-size", "0.05", "-q"});
    ::usleep(static_cast<useconds_t>(wait));
    ::kill(running.id(), SIGKILL);
    running.outcome();
    const std::string left = read_file(output);
    EXPECT_TRUE(left == "the old one" || left == whole) << "after " << wait << " µs";
    EXPECT_EQ(folder.count(), 2) << "after " << wait << " µs";
  }
}

TEST_F(BakeCommandTest, TexelsThatAreTooManyForAPageAreRefused) {
  const Outcome outcome = bake({"--texel-size", "0.0001", "-q"}, folder / "b.glb");
  expect_refused(outcome, 2,
                 "--texel-size: texels of 0.0001 m are 60000 along a side of a surface, and a "
                 "texture holds 4088; give --texel-size " +
                     outcome.err.substr(outcome.err.find("give --texel-size ") + 18,
                                        outcome.err.find(" or cut") -
                                            outcome.err.find("give --texel-size ") - 18) +
                     " or cut the surface into parts");
  EXPECT_EQ(folder.count(), 1);
}

TEST_F(BakeCommandTest, MemoryDoesNotGrowWithTheNumberOfSamples) {
  const auto peak = [&](const char* samples) {
    EXPECT_EQ(bake({"--texel-size", "0.02", "--light-samples", samples, "--threads", "1", "--stats",
                    folder / "s.json", "-q"},
                   folder / "b.glb")
                  .status,
              0);
    const std::string stats = read_file(folder / "s.json");
    const std::size_t at = stats.find("\"peak_bytes\"");
    EXPECT_NE(at, stats.npos) << stats;
    return std::stod(stats.substr(stats.find(':', at) + 1));
  };
  EXPECT_LT(peak("512"), 1.2 * peak("8"));
}

TEST_F(BakeCommandTest, StoredVisibilityIsShownByRender) {
  ASSERT_EQ(render(scene, folder / "truth.png", "area").status, 0);
  const Image truth = read_png(folder / "truth.png");
  for (const char* what : {"visibility", "samples"}) {
    const Outcome outcome = bake({"--store", what, "--texel-size", "0.03", "-q"}, folder / "b.glb");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Outcome shown =
        penumbra({"render", folder / "b.glb", "-o", folder / "b.png", "--size", "160x90"});
    ASSERT_EQ(shown.status, 0) << shown.err;
    EXPECT_THAT(shown.err, ::testing::HasSubstr("stored in the file"));
    // The polygon does not receive.
    EXPECT_LT(differing(read_png(folder / "b.png"), truth), 0.03) << what;
  }
}

TEST_F(BakeCommandTest, StoredLightsMayChangeTheirColours) {
  ASSERT_EQ(bake({"--store", "visibility", "--texel-size", "0.05", "-q"}, folder / "b.glb").status,
            0);
  const std::vector<std::string> words{"--size", "160x90",         "--exposure", "0",
                                       "-q",     "--light-factor", "0=1,0.5,0.1"};
  std::vector<std::string> stored{"render", folder / "b.glb", "-o", folder / "b.png"},
      traced{"render", folder / "b.glb", "-o", folder / "t.png", "--shadows", "area"};
  for (auto* all : {&stored, &traced}) {
    all->insert(all->end(), words.begin(), words.end());
    ASSERT_EQ(penumbra(*all).status, 0);
  }
  EXPECT_LT(differing(read_png(folder / "b.png"), read_png(folder / "t.png")), 0.03);
  for (const auto& [factor, line] :
       {std::pair{"key=2", "--light-factor: the scene has no light 'key'"},
        std::pair{"0=-1", "--light-factor: '0=-1' is not one or three numbers from 0 to 1e6"},
        std::pair{"2", "--light-factor: '2' names no light"}}) {
    const Outcome wrong =
        penumbra({"render", scene, "-o", folder / "w.png", "--light-factor", factor, "-q"});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_THAT(wrong.err, ::testing::StartsWith("penumbra: " + std::string(line)));
  }
  const Outcome added = penumbra(
      {"render", folder / "b.glb", "-o", folder / "w.png", "--light", "sphere:0,2,0,0.1,5", "-q"});
  EXPECT_EQ(added.status, 2);
  EXPECT_THAT(added.err, ::testing::HasSubstr("is not stored in the file"));
}

TEST_F(BakeCommandTest, WhatBelongsToRadianceIsRefusedWithAnotherStore) {
  expect_refused(bake({"--store", "samples", "--hdr"}, folder / "b.glb"), 2,
                 "--hdr: it belongs to --store radiance; leave it or --store out");
  expect_refused(bake({"--store", "samples", "--error", "0.1"}, folder / "b.glb"), 2,
                 "--error: it belongs to --store radiance; leave it or --store out");
  expect_refused(bake({"--store", "bits"}, folder / "b.glb"), 2,
                 "--store: 'bits' is unknown; did you mean samples? There are radiance, "
                 "visibility or samples");
}

}  // namespace
}  // namespace penumbra::test
