#include <cstdlib>
#include <filesystem>

#include "image/png.h"
#include "scene_fixture.h"

namespace penumbra::test {
namespace {

class AnimateTest : public SceneTest {
 protected:
  AnimateTest() : moving(folder / "moving.json") {
    write_file(moving, R"({
      "camera": {"position": [0, 2, 6], "look_at": [0, 0, 0]},
      "materials": {"gray": {"diffuse": [0.5, 0.5, 0.5]}},
      "objects": [
        {"type": "box", "min": [-1, 0, -1], "max": [1, 0.2, 1], "material": "gray"},
        {"type": "quad", "corner": [-9, -1, 9], "edge_u": [18, 0, 0], "edge_v": [0, 0, -18],
         "material": "gray"}],
      "lights": [{"type": "sphere", "position": [0, 5, 0], "radius": 0.5, "radiance": [9, 9, 9],
        "keyframes": [{"time": 0, "position": [-1, 5, 0]}, {"time": 0.5, "position": [1, 5, 0]}]}]})");
  }
  Outcome animate(const std::string& file, const std::string& output,
                  std::vector<std::string> options, const std::function<void()>& prepare = {}) {
    std::vector<std::string> words{"animate", file, "-o", output, "--size", "32x24", "--spp", "1"};
    words.insert(words.end(), options.begin(), options.end());
    return penumbra(words, prepare);
  }
  std::string frame(int i) const { return folder / ("f/" + std::to_string(i) + ".png"); }

  std::string moving;
};

TEST_F(AnimateTest, DrawsEveryFrameToTheLastKeyframe) {
  const Outcome outcome = animate(moving, folder / "f/%d.png", {"--fps", "8", "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (int i = 0; i < 5; ++i) EXPECT_EQ(read_png(frame(i)).width, 32) << i;
  EXPECT_FALSE(std::filesystem::exists(frame(5)));
  // As render shows the moment, but with the exposure of the first frame.
  const std::string one = folder / "one.png", ev = "0.5";
  EXPECT_EQ(animate(moving, folder / "f/%d.png", {"--fps", "8", "--exposure", ev}).status, 0);
  EXPECT_EQ(penumbra({"render", moving, "-o", one, "--size", "32x24", "--spp", "1", "--time",
                      "0.25", "--exposure", ev})
                .status,
            0);
  EXPECT_EQ(read_file(one), read_file(frame(2)));
  EXPECT_NE(read_file(one), read_file(frame(1)));
}

TEST_F(AnimateTest, ResumesWithWhatIsMissing) {
  const std::vector<std::string> options{"--fps", "8", "--quiet"};
  ASSERT_EQ(animate(moving, folder / "f/%d.png", options).status, 0);
  const std::string second = read_file(frame(1));
  std::filesystem::remove(frame(1));
  write_file(frame(3), "kept");
  ASSERT_EQ(animate(moving, folder / "f/%d.png", {"--fps", "8", "--quiet", "--resume"}).status, 0);
  EXPECT_EQ(read_file(frame(1)), second);
  EXPECT_EQ(read_file(frame(3)), "kept");
  ASSERT_EQ(animate(moving, folder / "f/%d.png", options).status, 0);
  EXPECT_NE(read_file(frame(3)), "kept");
}

TEST_F(AnimateTest, ATurntableGoesRound) {
  EXPECT_EQ(animate(moving, folder / "f/%d.png",
                    {"--frames", "4", "--turntable", "100", "--fps", "10000"})
                .status,
            0);
  EXPECT_NE(read_file(frame(0)), read_file(frame(1)));
  EXPECT_FALSE(std::filesystem::exists(frame(4)));
}

TEST_F(AnimateTest, RefusesInOneLine) {
  const auto frames = folder / "f/%d.png";
  expect_refused(
      animate(scene, frames, {"--quiet"}), 2,
      scene +
          ": nothing moves in this scene; give its things \"keyframes\", or add --turntable 360");
  const std::string one = folder / "one.png";
  expect_refused(animate(moving, one, {"--quiet"}), 2,
                 one +
                     ": this names one file, and a film has many frames; write -o frames/%04d.png, "
                     "or a film: -o film.mp4");
  for (const char* name : {"%s.png", "%d-%d.png", "%3d.png", "%0999d.png", "a%"})
    EXPECT_EQ(animate(moving, folder / name, {"--quiet"}).status, 2) << name;
  EXPECT_EQ(animate(moving, folder / "%d.bmp", {"--quiet"}).status, 2);
  EXPECT_EQ(animate(moving, frames, {"--aov", "depth=" + folder / "d.exr"}).status, 2);
  const Outcome none =
      animate(moving, folder / "a.mp4", {"--quiet"}, [] { ::setenv("PATH", "/nowhere", 1); });
  expect_refused(none, 2,
                 "films are made by ffmpeg, and there is none on this machine; install it, or "
                 "write frames: -o frames/%04d.png");
  EXPECT_FALSE(std::filesystem::exists(folder / "f"));
}

TEST_F(AnimateTest, AKeyframeThatCannotBeIsFoundBeforeTheFirstFrame) {
  std::string text = read_file(moving);
  const std::string last = R"("position": [1, 5, 0])";
  text.replace(text.find(last), last.size(), R"("radius": -1)");
  write_file(moving, text);
  const Outcome outcome = animate(moving, folder / "f/%d.png", {"--quiet"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("\"radius\" is -1"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "f"));
}

TEST_F(AnimateTest, MakesFilms) {
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs ffmpeg";
  for (const char* name : {"a.mp4", "b.gif"}) {
    const Outcome outcome = animate(moving, folder / name, {"--fps", "8", "--quiet"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_GT(std::filesystem::file_size(folder / name), 500u);
    EXPECT_FALSE(std::filesystem::exists(folder / (std::string(name) + ".frames")));
  }
}

// Between two frames a visible fraction changes by no more than the light moves, in its widths.
TEST_F(AnimateTest, ShadowsFollowTheLightWithoutFlicker) {
  std::string points = "x,y,z,nx,ny,nz\n";
  const int count = 60, frames = 40;
  for (int i = 0; i < count; ++i)
    points +=
        std::to_string(-2.4 + 0.08 * i) + ",-1," + std::to_string(-1.3 + 0.04 * i) + ",0,1,0\n";
  write_file(folder / "in.csv", points);
  struct Method {
    std::vector<std::string> options;
    double noise;
  };
  const Method methods[] = {{{"parker"}, 0},
                            {{"area", "--light-samples", "256"}, 4.0 / 256},
                            {{"sdf-classic"}, 0.02},
                            {{"sdf-inner"}, 0.02}};
  for (const Method& method : methods) {
    std::vector<double> before;
    double most = 0, range = 0;
    for (int f = 0; f <= frames; ++f) {
      std::vector<std::string> words{"probe",           moving,   "--points",
                                     folder / "in.csv", "-o",     folder / "out.csv",
                                     "--quiet",         "--time", std::to_string(0.5 * f / frames),
                                     "--shadows"};
      words.insert(words.end(), method.options.begin(), method.options.end());
      ASSERT_EQ(penumbra(words).status, 0);
      std::istringstream lines(read_file(folder / "out.csv"));
      std::string line;
      std::getline(lines, line);
      std::vector<double> now;
      while (std::getline(lines, line)) now.push_back(std::stod(line.substr(line.rfind(',') + 1)));
      ASSERT_EQ(now.size(), static_cast<std::size_t>(count));
      for (std::size_t i = 0; i < before.size(); ++i)
        most = std::max(most, std::abs(now[i] - before[i]));
      for (const double v : now) range = std::max(range, v);
      before = now;
    }
    // 2 m in 40 steps past a light 1 m wide; no method's profile is steeper than 4 a width.
    EXPECT_LT(most, 4 * 0.05 + method.noise) << method.options[0];
    EXPECT_GT(most, 0.01) << method.options[0];
    EXPECT_GT(range, 0.9) << method.options[0];
  }
}

}  // namespace
}  // namespace penumbra::test
