// --shadows heckbert-herf in render and probe.
#include <cmath>
#include <sstream>

#include "image/exr.h"
#include "scene_fixture.h"

namespace penumbra::test {
namespace {

// A floor under a ball, a box and a lamp that the floor's penumbrae are wide under; a wall that is
// lit at a low angle.
constexpr const char* room = R"({
  "camera": {"position": [3, 2.5, 4], "look_at": [0, 0.3, 0]},
  "materials": {"grey": {"diffuse": [0.7, 0.7, 0.7]}},
  "objects": [
    {"type": "quad", "corner": [-3, 0, 3], "edge_u": [6, 0, 0], "edge_v": [0, 0, -6], "material": "grey"},
    {"type": "quad", "corner": [-3, 0, -3], "edge_u": [6, 0, 0], "edge_v": [0, 3, 0], "material": "grey"},
    {"type": "sphere", "center": [0, 0.8, 0], "radius": 0.4, "material": "grey"},
    {"type": "box", "min": [0.8, 0, -0.4], "max": [1.4, 0.9, 0.4], "material": "grey"}],
  "lights": [LIGHT],
  "ambient": [0.02, 0.02, 0.02]
})";
const std::vector<std::pair<std::string, std::string>> lights = {
    {"sphere",
     R"({"type": "sphere", "position": [-1, 3, 1], "radius": 0.4, "radiance": [20, 20, 20]})"},
    {"rect",
     R"({"type": "rect", "corner": [-1.5, 3, 0.5], "edge_u": [1, 0, 0], "edge_v": [0, 0, 1],
         "radiance": [20, 20, 20]})"},
    {"sun",
     R"({"type": "sun", "direction": [0.4, -1, -0.5], "angular_diameter_deg": 6, "irradiance": [3, 3, 3]})"}};

class BakedLightTest : public SceneTest {
 protected:
  void use(const std::string& light) {
    std::string text = room;
    text.replace(text.find("LIGHT"), 5, light);
    write_file(scene, text);
  }
  /// The picture's channels and those of its layers.
  ExrFile picture(const std::vector<std::string>& options) {
    const std::string file = folder / "picture.exr";
    std::vector<std::string> words{"render", scene, "-o", file, "--size", "160x120", "--quiet"};
    words.insert(words.end(), {"--exposure", "0", "--spp", "1"});
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = penumbra(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return read_exr(file);
  }
};

double rmse(const ExrFile& a, const ExrFile& b, const std::string& channel) {
  const std::vector<float>&x = a.channels.at(channel).data, &y = b.channels.at(channel).data;
  EXPECT_EQ(x.size(), y.size());
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += std::pow(double(x[i]) - y[i], 2);
  return std::sqrt(sum / static_cast<double>(x.size()));
}

TEST_F(BakedLightTest, PicturesShowTheTrueLight) {
  for (const auto& [name, light] : lights) {
    SCOPED_TRACE(name);
    use(light);
    const ExrFile truth = picture({"--shadows", "area", "--light-samples", "1024"});
    const ExrFile baked = picture({"--shadows", "heckbert-herf", "--light-samples", "256"});
    const ExrFile none = picture({"--shadows", "none"});
    EXPECT_LT(rmse(truth, baked, "R"), 0.008);
    EXPECT_GT(rmse(truth, none, "R"), 8 * rmse(truth, baked, "R"));
    EXPECT_LT(rmse(truth, baked, "visibility.0"), 0.04);
  }
}

TEST_F(BakedLightTest, CoarseTexelsBlur) {
  use(lights[2].second);
  const ExrFile truth = picture({"--shadows", "area", "--light-samples", "1024"});
  const ExrFile fine = picture({"--shadows", "heckbert-herf", "--texel-size", "0.01"});
  const ExrFile coarse = picture({"--shadows", "heckbert-herf", "--texel-size", "0.3"});
  EXPECT_GT(rmse(truth, coarse, "R"), 2 * rmse(truth, fine, "R"));
}

// Heckbert and Herf's figures 1 and 2.
TEST_F(BakedLightTest, ARegularGridAveragesHardImages) {
  use(lights[1].second);
  const std::vector<std::string> method{"--shadows", "heckbert-herf", "--texel-size", "0.04",
                                        "--sample-grid"};
  const auto with = [&](const std::vector<std::string>& options) {
    std::vector<std::string> all = method;
    all.insert(all.end(), options.begin(), options.end());
    return picture(all);
  };
  ExrFile mean;
  for (const char* corner : {"-1.5,3,0.5", "-1,3,0.5", "-1.5,3,1", "-1,3,1"}) {
    const std::string quarter = std::string("rect:") + corner + ",0.5,0,0,0,0,0.5,80";
    const ExrFile hard =
        with({"regular", "--light-samples", "1", "--no-scene-lights", "--light", quarter});
    if (mean.channels.empty()) {
      mean = hard;
      for (float& x : mean.channels.at("R").data) x /= 4;
    } else {
      for (std::size_t i = 0; i < hard.channels.at("R").data.size(); ++i)
        mean.channels.at("R").data[i] += hard.channels.at("R").data[i] / 4;
    }
  }
  EXPECT_LT(rmse(mean, with({"regular", "--light-samples", "4"}), "R"), 1e-5);
  EXPECT_GT(rmse(mean, with({"jittered", "--light-samples", "4"}), "R"), 1e-3);
  EXPECT_GT(rmse(mean, with({"low-discrepancy", "--light-samples", "4"}), "R"), 1e-3);
}

TEST_F(BakedLightTest, ProbesAnswerAsTheReference) {
  std::string points = "x,y,z,nx,ny,nz\n";
  for (int i = 0; i < 400; ++i)
    points += std::to_string(-1.93 + 0.2 * (i % 20)) + ",0," +
              std::to_string(-1.93 + 0.2 * (i / 20)) + ",0,1,0\n";
  write_file(folder / "points.csv", points);
  const auto fractions = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"probe", scene, "--points", folder / "points.csv", "--quiet"});
    const Outcome outcome = penumbra(options);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    std::istringstream lines(outcome.out);
    std::vector<double> values;
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) values.push_back(std::stod(line.substr(line.rfind(',') + 1)));
    return values;
  };
  for (const auto& [name, light] : lights) {
    SCOPED_TRACE(name);
    use(light);
    const auto truth = fractions({"--shadows", "area", "--light-samples", "4096"});
    const auto baked = fractions({"--shadows", "heckbert-herf", "--light-samples", "256"});
    ASSERT_EQ(truth.size(), 400u);
    ASSERT_EQ(baked.size(), 400u);
    double sum = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) sum += std::pow(truth[i] - baked[i], 2);
    EXPECT_LT(std::sqrt(sum / 400), 0.02);
  }
}

TEST_F(BakedLightTest, OpenGlProbesTheSame) {
  use(lights[0].second);
  std::string points = "x,y,z,nx,ny,nz\n";
  for (int i = 0; i < 100; ++i)
    points += std::to_string(-1.93 + 0.4 * (i % 10)) + ",0," +
              std::to_string(-1.93 + 0.4 * (i / 10)) + ",0,1,0\n";
  write_file(folder / "points.csv", points);
  const auto probe = [&](const char* device) {
    return penumbra({"probe", scene, "--points", folder / "points.csv", "--quiet", "--shadows",
                     "heckbert-herf", "--light-samples", "64", "--device", device});
  };
  const Outcome gl = probe("gl"), cpu = probe("cpu");
  if (gl.status == 1) GTEST_SKIP() << gl.err;
  ASSERT_EQ(gl.status, 0) << gl.err;
  std::istringstream a(gl.out), b(cpu.out);
  std::string line, other;
  std::size_t differ = 0, penumbra = 0, count = 0;
  std::getline(a, line), std::getline(b, other);
  while (std::getline(a, line) && std::getline(b, other)) {
    const double x = std::stod(line.substr(line.rfind(',') + 1));
    const double y = std::stod(other.substr(other.rfind(',') + 1));
    ++count, differ += std::abs(x - y) > 0.02, penumbra += y > 0 && y < 1;
  }
  EXPECT_EQ(count, 100u);
  EXPECT_GT(penumbra, 5u);
  EXPECT_LE(differ, 2u);
}

TEST_F(BakedLightTest, TheSameBytesAtAnyNumberOfThreads) {
  use(lights[0].second);
  const std::vector<std::string> coarse{"--shadows", "heckbert-herf", "--texel-size", "0.05"};
  std::vector<std::string> one = coarse, three = coarse;
  one.insert(one.end(), {"--threads", "1"}), three.insert(three.end(), {"--threads", "3"});
  EXPECT_EQ(rmse(picture(one), picture(three), "R"), 0);
}

TEST_F(BakedLightTest, RefusesFieldsWithoutEnd) {
  write_file(scene, R"({"camera": {"position": [0, 2, 6], "look_at": [0, 0, 0]},
    "materials": {"grey": {}},
    "objects": [{"type": "sdf", "material": "grey", "root": {"shape": "plane", "normal": [0, 1, 0]}}],
    "lights": [{"type": "point", "position": [0, 3, 0], "intensity": [9, 9, 9]}]})");
  const Outcome outcome =
      penumbra({"render", scene, "-o", folder / "a.png", "--shadows", "heckbert-herf", "--quiet"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, ::testing::HasSubstr("has no end"));
  EXPECT_THAT(outcome.err, ::testing::HasSubstr("--bounds"));
}

}  // namespace
}  // namespace penumbra::test
