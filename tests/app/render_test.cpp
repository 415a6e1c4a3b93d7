#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "base/error.h"
#include "image/exr.h"
#include "image/heat_map.h"
#include "image/png.h"
#include "scene_fixture.h"

namespace penumbra::test {
namespace {

class RenderTest : public SceneTest {
 protected:
  Outcome render(const std::string& output, std::vector<std::string> options) {
    std::vector<std::string> words{"render", scene, "-o", output, "--size", "48x32"};
    words.insert(words.end(), options.begin(), options.end());
    return penumbra(words);
  }
};

TEST_F(RenderTest, EveryMethodMakesAPicture) {
  for (const char* method : {"none", "hard", "area", "parker"}) {
    const std::string file = folder / std::string(method) + ".png";
    const Outcome outcome = render(file, {"--shadows", method, "--quiet"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(read_png(file).width, 48);
    EXPECT_EQ(read_png(file).height, 32);
  }
  EXPECT_NE(read_file(folder / "none.png"), read_file(folder / "hard.png"));
  EXPECT_NE(read_file(folder / "hard.png"), read_file(folder / "parker.png"));
}

TEST_F(RenderTest, ExrHasEveryLayer) {
  EXPECT_EQ(render(folder / "a.exr", {"--exposure", "1.5"}).status, 0);
  const ExrFile file = read_exr(folder / "a.exr");
  std::vector<std::string> names;
  for (const auto& channel : file.channels) names.push_back(channel.first);
  EXPECT_THAT(names, ::testing::ElementsAre("B", "G", "R", "depth.Z", "normal.X", "normal.Y",
                                            "normal.Z", "visibility.0"));
  EXPECT_EQ(file.attributes.at("exposure"), "1.5 EV");
}

TEST_F(RenderTest, AovsAreWrittenBesideThePicture) {
  EXPECT_EQ(render(folder / "a.png", {"--aov", "depth=" + folder / "d.exr", "--aov",
                                      "visibility=" + folder / "v.exr"})
                .status,
            0);
  EXPECT_EQ(read_exr(folder / "d.exr").channels.count("depth.Z"), 1u);
  EXPECT_EQ(read_exr(folder / "v.exr").channels.count("visibility.0"), 1u);
  EXPECT_EQ(folder.count(), 4);
}

TEST_F(RenderTest, StepsAreAHeatMapToo) {
  EXPECT_EQ(
      render(folder / "a.png", {"--shadows", "sdf-inner", "--aov", "steps=" + folder / "s.exr",
                                "--aov", "steps=" + folder / "s.png"})
          .status,
      0);
  const Image counts = read_exr(folder / "s.exr").channels.at("steps.Y");
  write_png(folder / "expected.png", heat_map(counts));
  EXPECT_EQ(read_file(folder / "s.png"), read_file(folder / "expected.png"));
  EXPECT_GT(*std::ranges::max_element(counts.data), 4);
}

TEST_F(RenderTest, SameBytesAtAnyThreadCount) {
  for (const char* threads : {"1", "3"})
    EXPECT_EQ(render(folder / threads + std::string(".exr"),
                     {"--threads", threads, "--shadows", "area", "--light-samples", "8"})
                  .status,
              0);
  EXPECT_EQ(read_file(folder / "1.exr"), read_file(folder / "3.exr"));
}

TEST_F(RenderTest, StatsTellWhatWasDone) {
  EXPECT_EQ(render(folder / "a.png", {"--stats", folder / "s.json"}).status, 0);
  const std::string stats = read_file(folder / "s.json");
  for (const char* key :
       {"\"program\"", "\"command_line\"", "\"scene\"", "\"seconds\"", "\"load\"", "\"build\"",
        "\"render\"", "\"write\"", "\"rays\"", "\"primary\"", "\"cones\"", "\"peak_bytes\"",
        "\"structure_bytes\"", "\"threads\"", "\"exposure_ev\"", "\"lights\" : 1"})
    EXPECT_THAT(stats, ::testing::HasSubstr(key));
}

TEST_F(RenderTest, ProgressIsOneLineAPhaseAndOptionsWithoutEffectAreTold) {
  const Outcome outcome = render(folder / "a.png", {"--shadows", "hard", "--tolerance", "0"});
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err,
              ::testing::StartsWith(
                  "penumbra: warning: --tolerance has no effect with this method\nload: "));
  for (const char* line : {"\nbuild: ", "\nrender: ", "\nexposure: ", "\nwrite: "})
    EXPECT_THAT(outcome.err, ::testing::HasSubstr(line));
  EXPECT_THAT(outcome.err, ::testing::Not(::testing::HasSubstr("\r")));
}

TEST_F(RenderTest, CtrlCStopsWithinASecondAndLeavesNothing) {
  Running running(PENUMBRA_PROGRAM, {"render", scene, "-o", folder / "a.png", "--size", "4000x4000",
                                     "--spp", "64", "--shadows", "area"});
  ::usleep(300'000);
  const auto begin = std::chrono::steady_clock::now();
  ::kill(running.id(), SIGINT);
  const Outcome outcome = running.outcome();
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
  EXPECT_EQ(outcome.status, 130);
  EXPECT_LT(waited.count(), 1.0);
  EXPECT_EQ(folder.count(), 1);
}

TEST_F(RenderTest, NewSceneRendersAsItIs) {
  EXPECT_EQ(penumbra({"new", folder / "new.json"}).status, 0);
  const Outcome outcome = penumbra({"render", folder / "new.json", "-o", folder / "new.png",
                                    "--size", "32x18", "--spp", "1", "-q"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST_F(RenderTest, HelpAndVersion) {
  EXPECT_THAT(penumbra({"--version"}).out, ::testing::MatchesRegex("penumbra [0-9.]+\n"));
  const Outcome help = penumbra({"render", "--help"});
  EXPECT_EQ(help.status, 0);
  for (const char* option : {"--shadows", "--size", "--light", "--tolerance", "960x540", "--stats"})
    EXPECT_THAT(help.out, ::testing::HasSubstr(option));
  EXPECT_THAT(penumbra({"--help"}).out, ::testing::HasSubstr("probe"));
}

}  // namespace
}  // namespace penumbra::test
