#include "scene_fixture.h"

namespace penumbra::test {
namespace {

class ProbeTest : public SceneTest {
 protected:
  ProbeTest() : points(folder / "points.csv") {}

  Outcome probe(const std::string& csv, std::vector<std::string> options = {}) {
    write_file(points, csv);
    std::vector<std::string> words{"probe", scene, "--points", points, "--quiet"};
    words.insert(words.end(), options.begin(), options.end());
    return penumbra(words);
  }
  void expect_refused_at(const std::string& csv, const std::string& line) {
    expect_refused(probe(csv), 2, points + line);
  }

  std::string points;
};

// Below the sphere it is dark; far to the side the whole light is seen.
TEST_F(ProbeTest, AddsTheColumnAndKeepsTheRest) {
  const Outcome outcome = probe(
      "name,x,y,z,nx,ny,nz,light\n"
      "\"under, \"\"it\"\"\",0,-1,0,0,1,0,0\n"
      "aside , 8,-1,0,0,2,0,0\n");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "name,x,y,z,nx,ny,nz,light,visible_fraction\n"
            "\"under, \"\"it\"\"\",0,-1,0,0,1,0,0,0.000000\n"
            "aside , 8,-1,0,0,2,0,0,1.000000\n");
}

TEST_F(ProbeTest, ReplacesTheColumnInPlaceAndKeepsCrLf) {
  const Outcome outcome =
      probe("visible_fraction,z,y,x,nz,ny,nx\r\n,0,-1,8,0,1,0\r\n\r\n0.5,0,-1,0,0,1,0",
            {"--shadows", "hard"});
  EXPECT_EQ(
      outcome.out,
      "visible_fraction,z,y,x,nz,ny,nx\r\n1.000000,0,-1,8,0,1,0\r\n0.000000,0,-1,0,0,1,0\r\n");
}

TEST_F(ProbeTest, WritesAFileAndItsOwnInput) {
  EXPECT_EQ(probe("x,y,z,nx,ny,nz\n8,-1,0,0,1,0\n", {"-o", points}).status, 0);
  EXPECT_EQ(read_file(points), "x,y,z,nx,ny,nz,visible_fraction\n8,-1,0,0,1,0,1.000000\n");
  EXPECT_EQ(folder.count(), 2);
}

TEST_F(ProbeTest, LightsOfTheCommandLineComeAfterTheScenes) {
  const std::string csv = "x,y,z,nx,ny,nz,light\n8,-1,0,0,1,0,1\n";
  expect_refused(probe(csv), 2,
                 points + ":2:14: there is no light 1; the only light of the scene is 0");
  const std::string below = "sphere:8,-5,0,0.5,1";
  EXPECT_THAT(probe(csv, {"--light", below}).out, ::testing::EndsWith(",1,0.000000\n"));
  EXPECT_THAT(probe("x,y,z,nx,ny,nz\n8,-1,0,0,1,0\n",
                    {"--no-scene-lights", "--light", below, "--light-size", "2"})
                  .out,
              ::testing::EndsWith(",0.000000\n"));
}

TEST_F(ProbeTest, SameBytesAtAnyThreadCount) {
  std::string csv = "x,y,z,nx,ny,nz\n";
  for (int i = 0; i < 300; ++i) csv += std::to_string(i * 0.01) + ",-1,0.2,0,1,0\n";
  for (const char* method : {"parker", "area"}) {
    const Outcome one = probe(csv, {"--threads", "1", "--shadows", method});
    EXPECT_EQ(one.status, 0) << one.err;
    EXPECT_EQ(one.out, probe(csv, {"--threads", "4", "--shadows", method}).out);
  }
}

TEST_F(ProbeTest, PictureOptionsAreAcceptedWithAWarning) {
  write_file(points, "x,y,z,nx,ny,nz\n8,-1,0,0,1,0\n");
  const Outcome outcome = penumbra({"probe", scene, "--points", points, "--spp", "1"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err,
              ::testing::StartsWith("penumbra: warning: --spp has no effect on probe\n"));
}

TEST_F(ProbeTest, OptionsThatAnotherOneSilencesAreTold) {
  write_file(points, "x,y,z,nx,ny,nz\n8,-1,0,0,1,0\n");
  const auto warning = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"probe", scene, "--points", points});
    const std::string err = penumbra(options).err;
    return err.substr(0, err.find('\n'));
  };
  EXPECT_EQ(warning({"--shadows", "area", "--light-samples", "16", "--error", "0.1"}),
            "penumbra: warning: --light-samples has no effect beside --error");
  EXPECT_EQ(warning({"--composite", "multiply", "--tolerance", "0"}),
            "penumbra: warning: --tolerance has no effect with this --composite");
  EXPECT_THAT(warning({"--composite", "min", "--tolerance", "0"}), ::testing::StartsWith("load: "));
}

TEST_F(ProbeTest, MistakesInTheHeader) {
  expect_refused_at("", ":1:1: there is no header; begin with the line x,y,z,nx,ny,nz");
  expect_refused_at("x,y,z,nx,nz\n1,2,3,4,5\n",
                    ":1:1: there is no column 'ny'; name x,y,z,nx,ny,nz in the header");
  expect_refused_at("x,y,z,nx,ny,nz,x\n1,2,3,4,5,6,7\n",
                    ":1:16: there are two columns 'x'; rename one of them");
  expect_refused_at("x,y,z,nx,ny,nz\n", ": there are no points; add a row for each");
}

TEST_F(ProbeTest, MistakesInRows) {
  const std::string header = "x,y,z,nx,ny,nz,light\n";
  expect_refused_at(header + "0,0,0,0,1,0,0\n0,one,0,0,1,0,0\n",
                    ":3:3: 'one' is not a finite number; write it like 0.25 or 1e-3");
  expect_refused_at(header + "0,0,0,0,1,inf,0\n",
                    ":2:11: 'inf' is not a finite number; write it like 0.25 or 1e-3");
  expect_refused_at(header + "0,0,1e99,0,1,0,0\n",
                    ":2:5: '1e99' is not a finite number; write it like 0.25 or 1e-3");
  expect_refused_at(header + "0,-1e10,0,0,1,0,0\n",
                    ":2:3: -1e10 is beyond 1e+09; give points as near to the origin as scenes are");
  expect_refused_at(header + "0,0,0,0,0,0,0\n",
                    ":2:7: the normal is zero; give the direction that the surface faces");
  expect_refused_at(header + "0,0,0,0,1,0,-1\n",
                    ":2:13: there is no light -1; the only light of the scene is 0");
  expect_refused_at(header + "0,0,0,0,1,0,0.5\n",
                    ":2:13: '0.5' is not the index of a light; write a whole number from 0");
  expect_refused_at(header + "0,0,0,0,1,0\n",
                    ":2:1: this row has 6 fields and the header has 7; give every row a value for "
                    "each column");
}

TEST_F(ProbeTest, MistakesInQuotes) {
  const std::string remedy = "; write quotes inside a quoted field twice and close it";
  expect_refused_at("x,\"y\n", ":1:3: this quoted field does not end" + remedy);
  expect_refused_at("x,\"y\"y\n", ":1:3: text follows a quoted field" + remedy);
  expect_refused_at("x,y\n1,a\"b\n", ":2:3: a quote stands in the middle of a field" + remedy);
}

TEST_F(ProbeTest, NoLightAtAll) {
  expect_refused(probe("x,y,z,nx,ny,nz\n8,-1,0,0,1,0\n", {"--no-scene-lights"}), 2,
                 "the scene has no light to be seen; add one with --light");
}

}  // namespace
}  // namespace penumbra::test
