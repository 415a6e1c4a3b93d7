#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "scene_fixture.h"

namespace penumbra::test {
namespace {

// Options behind `render SCENE -o a.png`, and what is said to them; always exit status 2.
struct Misuse {
  std::vector<std::string> options;
  std::string line;
};

class RenderMisuse : public SceneTest, public ::testing::WithParamInterface<Misuse> {};

TEST_P(RenderMisuse, IsRefusedInOneLineWithoutAFile) {
  std::vector<std::string> words{"render", scene, "-o", folder / "a.png", "--quiet"};
  words.insert(words.end(), GetParam().options.begin(), GetParam().options.end());
  expect_refused(penumbra(words), 2, GetParam().line);
  EXPECT_EQ(folder.count(), 1);
}

INSTANTIATE_TEST_SUITE_P(
    Values, RenderMisuse,
    ::testing::Values(
        Misuse{{"--size", "0x0"},
               "--size: 0x0 has no pixels; give at least 1x1, as in --size 960x540"},
        Misuse{{"--size", "big"}, "--size: 'big' is not WIDTHxHEIGHT; write it as --size 960x540"},
        Misuse{{"--size", "-5x4"},
               "--size: '-5x4' is not WIDTHxHEIGHT; write it as --size 960x540"},
        Misuse{
            {"--size", "99999999999999999999x1"},
            "--size: 99999999999999999999x1 is beyond any memory; give at most 999999999 a side, "
            "and a size that fits"},
        Misuse{{"--spp", "four"},
               "--spp: 'four' is not a whole number; give a whole number from 1 "
               "to 65536"},
        Misuse{{"--spp", "0"}, "--spp: 0 is out of range; give a whole number from 1 to 65536"},
        Misuse{{"--seed", "-1"},
               "--seed: -1 is out of range; give a whole number from 0 to "
               "4294967295"},
        Misuse{{"--threads", "0"},
               "--threads: 0 is out of range; give a whole number from 1 to "
               "1024"},
        Misuse{{"--exposure", "bright"},
               "--exposure: 'bright' is not a number; give a number from -100 to 100"},
        Misuse{{"--exposure", "nan"},
               "--exposure: 'nan' is not a number; give a number from -100 to 100"},
        Misuse{{"--tolerance", "2"}, "--tolerance: 2 is out of range; give a number from 0 to 1"},
        Misuse{{"--error", "0"}, "--error: 0 is out of range; give a number from 0.0001 to 1"},
        Misuse{{"--light-samples", "1e3"},
               "--light-samples: '1e3' is not a whole number; give a "
               "whole number from 1 to 1048576"},
        Misuse{{"--light-size", "0"},
               "--light-size: 0 is out of range; give a number from 1e-06 to 1e+06"},
        Misuse{{"--mirror-depth", "65"},
               "--mirror-depth: 65 is out of range; give a whole number "
               "from 0 to 64"},
        Misuse{{"--spp"}, "--spp: its value is missing; give one; see --help"}));

INSTANTIATE_TEST_SUITE_P(
    Names, RenderMisuse,
    ::testing::Values(
        Misuse{{"--shadows", "prker"},
               "--shadows: 'prker' is unknown; did you mean parker? There are none, hard, area, "
               "parker, heckbert-herf, sdf-classic, sdf-improved or sdf-inner"},
        Misuse{{"--shadows", "heckbert-herf", "--device", "gl"},
               "--shadows: OpenGL does not draw heckbert-herf pictures; leave out --device gl"},
        Misuse{{"--shadows", "heckbert-herf", "--texel-size", "0"},
               "--texel-size: 0 is out of range; give a number from 1e-06 to 1e+06"},
        Misuse{{"--shadows", "heckbert-herf", "--sample-grid", "regula"},
               "--sample-grid: 'regula' is unknown; did you mean regular? There are jittered, "
               "regular or low-discrepancy"},
        Misuse{{"--variant", "blog"},
               "--variant: blog is a variant of sdf-classic; add --shadows sdf-classic"},
        Misuse{{"--shadows", "sdf-classic", "--variant", "abs"},
               "--variant: abs is a variant of sdf-inner; add --shadows sdf-inner"},
        Misuse{{"--shadows", "sdf-classic", "--variant", "march"},
               "--variant: march is a variant of hard; add --shadows hard"},
        Misuse{
            {"--profile", "qubic"},
            "--profile: 'qubic' is unknown; did you mean cubic? There are cubic, sine or linear"},
        Misuse{{"--composite", "max"},
               "--composite: 'max' is unknown; did you mean min? There are min, multiply or add"},
        Misuse{{"--device", "rays"},
               "--device: rays is a device of bake alone; use auto, cpu or gl"},
        Misuse{{"--shadow", "hard"}, "--shadow is no option of render; did you mean --shadows?"},
        Misuse{{"--mint=0"}, "--mint: 0 is out of range; give a number from 1e-06 to 1e+06"},
        Misuse{{"--k", "-1"}, "--k: -1 is out of range; give a number from 1e-06 to 1e+06"},
        Misuse{{"--steps", "0"}, "--steps: 0 is out of range; give a whole number from 1 to 65535"},

        Misuse{{"other.json"}, "'other.json' is one file too many; see penumbra render --help"},
        Misuse{{"--camera", "frnt"},
               "--camera: the scene has no camera 'frnt'; did you mean "
               "'front'? An index, 0, will do too"},
        Misuse{{"--camera", "1"},
               "--camera: the scene has no camera '1'; did you mean 'front'? An "
               "index, 0, will do too"},
        Misuse{{"--aov", "depth"},
               "--aov: 'depth' is not NAME=FILE.exr; write it as --aov "
               "depth=depth.exr"},
        Misuse{{"--aov", "deep=a.exr"},
               "--aov: 'deep' is unknown; did you mean depth? There are "
               "visibility, depth, normal, error or steps"},
        Misuse{{"--aov", "depth=a.png"},
               "--aov: a.png does not end in .exr; write it as --aov depth=depth.exr"},
        Misuse{{"--aov", "steps=a.jpg"},
               "--aov: a.jpg does not end in .exr; write it as --aov steps=steps.exr"}));

INSTANTIATE_TEST_SUITE_P(
    Lights, RenderMisuse,
    ::testing::Values(
        Misuse{{"--light", "spere:0,1,0,1,1"},
               "--light: 'spere' is unknown; did you mean sphere? There are sphere, disk, rect, "
               "segment, point or sun"},
        Misuse{{"--light", "sphere:0,1,0,-1,5"},
               "--light sphere:0,1,0,-1,5: the radius is not positive; write "
               "sphere:px,py,pz,radius,radiance"},
        Misuse{{"--light", "sphere:0,1e10,0,1,5"},
               "--light sphere:0,1e10,0,1,5: '1e10' is beyond 1e+09; write "
               "sphere:px,py,pz,radius,radiance"},
        Misuse{{"--light", "sphere:0,1,0,1,1e13"},
               "--light sphere:0,1,0,1,1e13: '1e13' is beyond 1e+12; write "
               "sphere:px,py,pz,radius,radiance"},
        Misuse{{"--light", "sphere:0,1,0,1e-13,5"},
               "--light sphere:0,1,0,1e-13,5: the radius is below 1e-12; write "
               "sphere:px,py,pz,radius,radiance"},
        Misuse{{"--light", "sphere:0,1,0,1"},
               "--light sphere:0,1,0,1: 4 numbers instead of 5 or 7; write "
               "sphere:px,py,pz,radius,radiance"},
        Misuse{{"--light", "sphere"},
               "--light sphere: there are no numbers; write sphere:px,py,pz,radius,radiance"},
        Misuse{{"--light", "point:0,1,x,5"},
               "--light point:0,1,x,5: 'x' is not a number; write point:px,py,pz,intensity"},
        Misuse{{"--light", "disk:0,1,0,0,0,0,1,5"},
               "--light disk:0,1,0,0,0,0,1,5: the normal is zero; write "
               "disk:px,py,pz,nx,ny,nz,radius,radiance"},
        Misuse{{"--light", "rect:0,1,0,1,0,0,2,0,0,5"},
               "--light rect:0,1,0,1,0,0,2,0,0,5: the edges span no area; write "
               "rect:cx,cy,cz,ux,uy,uz,vx,vy,vz,radiance"},
        Misuse{{"--light", "segment:0,1,0,0,1,0,1,5"},
               "--light segment:0,1,0,0,1,0,1,5: its ends are the same point; write "
               "segment:ax,ay,az,bx,by,bz,radius,radiance"},
        Misuse{{"--light", "sun:0,-1,0,180,5"},
               "--light sun:0,-1,0,180,5: the angular diameter is not in [0, 180) degrees; write "
               "sun:dx,dy,dz,angular_diameter_deg,irradiance"},
        Misuse{
            {"--light", "point:0,1,0,-5"},
            "--light point:0,1,0,-5: the emission is negative; write point:px,py,pz,intensity"}));

class Misuses : public SceneTest {};

TEST_F(Misuses, Commands) {
  expect_refused(penumbra({}), 2,
                 "no command is given; use render, probe, info, new, export, bake or diff; see "
                 "penumbra --help");
  expect_refused(penumbra({"rendr", scene}), 2,
                 "'rendr' is no command; did you mean render? There are render, probe, info, new, "
                 "export, bake or diff");
  expect_refused(penumbra({"--quiet"}), 2,
                 "--quiet is no option here; begin with a command, as in penumbra render SCENE -o "
                 "OUT.png");
}

TEST_F(Misuses, MissingParts) {
  expect_refused(penumbra({"render"}), 2, "no scene is named; write penumbra render SCENE");
  expect_refused(penumbra({"render", scene}), 2,
                 "no output is named; add -o OUT.png or -o OUT.exr");
  expect_refused(penumbra({"probe", scene}), 2, "no points are named; add --points IN.csv");
  expect_refused(penumbra({"new"}), 2, "no file is named; write penumbra new NAME.json");
}

TEST_F(Misuses, TooLargeASizeTellsWhatItNeedsBeforeLoading) {
  const Outcome outcome = penumbra(
      {"render", folder / "none.json", "-o", folder / "a.png", "--size", "1000000x1000000"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, ::testing::MatchesRegex(
                               "penumbra: --size: a picture of 1000000x1000000 needs 12.0 TB of "
                               "memory and [0-9.]+ [MGT]B are available; choose a smaller size\n"));
  EXPECT_EQ(folder.count(), 1);
}

TEST_F(Misuses, BoundsAndVoxels) {
  const auto expect = [&](const std::string& option, const std::string& value,
                          const std::string& line) {
    expect_refused(penumbra({"info", scene, option, value}), 2, line);
  };
  const std::string remedy =
      "; write it as --bounds -1,0,-1,1,2,1: the least x, y, z, then the greatest";
  expect("--bounds", "0,0,0,1,1",
         "--bounds: '0,0,0,1,1' is not six numbers of at most 1e9" + remedy);
  expect("--bounds", "0,0,0,1,1,x",
         "--bounds: '0,0,0,1,1,x' is not six numbers of at most 1e9" + remedy);
  expect("--bounds", "0,0,0,1,0,1", "--bounds: 0,0,0,1,0,1 is empty along y" + remedy);
  expect("--voxel-size", "0", "--voxel-size: 0 is out of range; give a number from 1e-09 to 1e+09");
}

TEST_F(Misuses, MissingScene) {
  const std::string name = folder / "none.json";
  expect_refused(penumbra({"render", name, "-o", folder / "a.png", "-q"}), 2,
                 name + ": there is no such file; check the name");
}

TEST_F(Misuses, OutputsAreCheckedBeforeTheScene) {
  const std::string none = folder / "none.json", lost = folder / "lost/a.png";
  expect_refused(penumbra({"render", none, "-o", lost}), 1,
                 lost + ": the folder " + folder / "lost" +
                     " does not exist; create it or choose another output");
  expect_refused(penumbra({"render", none, "-o", "a.jpg"}), 2,
                 "a.jpg: this is no picture format that can be written; let it end in .png or "
                 ".exr");
  const std::string twice = folder / "a.exr";
  expect_refused(penumbra({"render", none, "-o", twice, "--aov", "depth=" + twice}), 2,
                 twice + ": two outputs have this name; give each its own");
  const std::string again = folder / "." + "/a.exr";
  expect_refused(penumbra({"render", none, "-o", twice, "--aov", "depth=" + again}), 2,
                 again + ": two outputs have this name; give each its own");
  expect_refused(penumbra({"render", scene, "-o", twice, "--stats", scene}), 2,
                 scene + ": this is the scene itself; name another file for the output");
  const std::string stats = folder / "lost/stats.json";
  expect_refused(penumbra({"render", none, "-o", twice, "--stats", stats}), 1,
                 stats + ": the folder " + folder / "lost" +
                     " does not exist; create it or choose another output");
  ::mkdir((folder / "a.png").c_str(), 0777);
  expect_refused(penumbra({"render", none, "-o", folder / "a.png"}), 1,
                 folder / "a.png" + ": this is a folder; name a file for the output");
  EXPECT_EQ(folder.count(), 2);
}

TEST_F(Misuses, OutputFolderThatMayNotBeWritten) {
  const std::string locked = folder / "locked";
  ::mkdir(locked.c_str(), 0555);
  if (::access(locked.c_str(), W_OK) == 0) GTEST_SKIP() << "the superuser may write anywhere";
  expect_refused(penumbra({"render", scene, "-o", locked + "/a.png"}), 1,
                 locked + "/a.png: cannot be written (Permission denied); choose another output");
}

// Not even the superuser may make files there.
TEST_F(Misuses, FolderThatTakesNoFiles) {
  const Outcome outcome = penumbra({"render", scene, "-o", "/proc/a.png"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, ::testing::MatchesRegex("penumbra: /proc/a.png: cannot be written "
                                                   "\\([A-Za-z ]+\\); choose another output\n"));
}

TEST_F(Misuses, DevicesAreNoOutputs) {
  const Outcome outcome =
      penumbra({"render", scene, "-o", folder / "a.png", "--stats", "/dev/null"});
  expect_refused(outcome, 1, "/dev/null: this is not an ordinary file; choose another output");
}

TEST_F(Misuses, VisibilityOfNoLight) {
  expect_refused(penumbra({"render", scene, "-o", folder / "a.png", "--no-scene-lights", "--aov",
                           "visibility=" + folder / "v.exr", "-q"}),
                 2,
                 "--aov visibility: the scene has no light to be seen; add one with --light or "
                 "leave it out");
  EXPECT_EQ(folder.count(), 1);
}

TEST_F(Misuses, LightsThatGrowBeyondAllScenes) {
  expect_refused(penumbra({"render", scene, "-o", folder / "a.png", "--light-size", "1e6",
                           "--light", "rect:0,1,0,1e4,0,0,0,0,1,5", "-q"}),
                 2, "--light-size: light 1 becomes larger than 1e+09; give a smaller factor");
}

void limit_files_to_200_bytes() {
  const rlimit limit{200, 200};
  ::setrlimit(RLIMIT_FSIZE, &limit);
}

TEST_F(Misuses, FullDiskLeavesNothing) {
  for (const char* name : {"a.png", "a.exr"}) {
    const std::string file = folder / name;
    const Outcome outcome =
        penumbra({"render", scene, "-o", file, "--size", "64x64", "-q", "--shadows", "hard"},
                 limit_files_to_200_bytes);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, ::testing::StartsWith("penumbra: " + file + ": cannot be written ("));
    EXPECT_THAT(outcome.err, ::testing::EndsWith("); free some space or choose another output\n"));
    EXPECT_EQ(folder.count(), 1);
  }
}

TEST_F(Misuses, FullStandardOutput) {
  const Outcome outcome = penumbra(
      {"info", scene}, [] { ::dup2(::open("/dev/full", O_WRONLY | O_CLOEXEC), STDOUT_FILENO); });
  expect_refused(outcome, 1,
                 "standard output: cannot be written (No space left on device); free some space or "
                 "choose another output");
}

TEST_F(Misuses, NewOverwritesNothing) {
  expect_refused(penumbra({"new", scene}), 1,
                 scene + ": this file is there already; choose another name");
  expect_refused(penumbra({"new", "scene.txt"}), 2,
                 "scene.txt: this is no scene file's name; let it end in .json");
}

}  // namespace
}  // namespace penumbra::test
