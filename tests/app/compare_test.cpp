#include <json/reader.h>
#include <signal.h>
#include <stdlib.h>

#include <sstream>
#include <thread>

#include "image/png.h"
#include "scene_fixture.h"
#include "support/json_schema.h"

namespace penumbra::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Json::Value json_of(const std::string& text) {
  Json::Value value;
  std::istringstream(text) >> value;
  return value;
}

class Compare : public SceneTest {
 protected:
  /// On a picture of 64 × 48.
  Outcome compare(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"compare", scene,   "-o",        out,
                                   "--size",  "64x48", "--repeats", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return penumbra(words);
  }
  Json::Value results() const { return json_of(read_file(out + "/results.json")); }

  /// The method of that name.
  static Json::Value method(const Json::Value& results, const std::string& name) {
    for (const Json::Value& m : results["methods"])
      if (m["name"] == name) return m;
    ADD_FAILURE() << "no " << name;
    return {};
  }

  const std::string out = folder / "out";
};

void expect_valid(const Json::Value& results) {
  const JsonSchema schema(json_of(read_file(PENUMBRA_SOURCE_DIR "/docs/compare.schema.json")));
  EXPECT_EQ(schema.complaints(results), "");
}

TEST_F(Compare, WritesAPageWithAllMethodsAndTheirErrors) {
  const Outcome outcome = compare();
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("use "));
  const Json::Value found = results();
  expect_valid(found);
  ASSERT_EQ(found["methods"].size(), 7u);
  for (const Json::Value& m : found["methods"]) {
    EXPECT_EQ(m["status"], "ok") << m["reason"].asString();
    EXPECT_THAT(outcome.out, HasSubstr(m["name"].asString()));
    for (const char* key : {"picture", "visibility", "error_map"}) {
      const Image picture = read_png(out + "/" + m[key].asString());
      EXPECT_EQ(picture.width, 64);
      EXPECT_EQ(picture.height, 48);
    }
    const std::string data = read_file(out + "/" + m["data"].asString());
    EXPECT_THAT(data, ::testing::StartsWith("penumbraData(\"" + m["name"].asString() + "\", {"));
  }
  EXPECT_GE(found["reference"]["share_within"].asDouble(), 0.999);
  // The known flaws: parker's umbra is too large, sdf-inner is close; area is closest.
  const auto error = [&](const char* name) {
    return method(found, name)["error"]["penumbra"]["rmse"].asDouble();
  };
  EXPECT_GT(error("parker"), error("hard"));
  EXPECT_LT(error("sdf-inner"), 0.5 * error("hard"));
  EXPECT_LT(error("area"), 0.03);
  EXPECT_LT(method(found, "parker")["error"]["penumbra"]["bias"].asDouble(), -0.2);
  EXPECT_EQ(method(found, "hard")["cost"]["relative_to_hard"].asDouble(), 1);
  EXPECT_GT(method(found, "hard")["cost"]["rays"].asInt(), 500);
  EXPECT_GT(method(found, "sdf-inner")["cost"]["distance_evaluations"].asInt(), 1000);
  EXPECT_GT(method(found, "heckbert-herf")["cost"]["texel_samples"].asInt64(), 1000000);
  // 64 points do as well as 64 points.
  EXPECT_NEAR(method(found, "area")["equal_area"]["points"].asInt(), 64, 32);
}

TEST_F(Compare, PutsTheResultsIntoThePage) {
  ASSERT_EQ(compare({"--shadows", "hard"}).status, 0);
  const std::string page = read_file(out + "/index.html");
  const std::string begin = "<script type=\"application/json\" id=\"results\">";
  const std::size_t at = page.find(begin);
  ASSERT_NE(at, page.npos);
  const std::size_t first = at + begin.size();
  EXPECT_EQ(json_of(page.substr(first, page.find("</script>", first) - first)), results());
}

TEST_F(Compare, TakesAListOfMethodsAndEveryOptionOfRender) {
  const Outcome outcome = compare({"--shadows", "parker,sdf-classic", "--variant", "blog",
                                   "--profile", "linear", "--light-size", "2", "--camera", "front",
                                   "--exposure", "1", "--stats", folder / "stats.json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json::Value found = results();
  expect_valid(found);
  ASSERT_EQ(found["methods"].size(), 2u);
  EXPECT_EQ(found["exposure_ev"].asDouble(), 1);
  EXPECT_TRUE(method(found, "parker")["cost"]["relative_to_hard"].isNull());
  EXPECT_THAT(method(found, "sdf-classic")["command"].asString(),
              HasSubstr("--light-size 2 --camera front --exposure 1 --shadows sdf-classic "
                        "--variant blog -o sdf-classic.png"));
  EXPECT_THAT(method(found, "parker")["command"].asString(), Not(HasSubstr("variant")));
  EXPECT_GT(json_of(read_file(folder / "stats.json"))["seconds"]["compare"].asDouble(), 0);
}

// What is printed draws the picture that is shown.
TEST_F(Compare, NamesTheCommandOfEachPicture) {
  ASSERT_EQ(compare({"--shadows", "parker", "--spp", "2"}).status, 0);
  std::istringstream words(method(results(), "parker")["command"].asString());
  std::vector<std::string> command;
  for (std::string word; words >> word;) command.push_back(word);
  command.erase(command.begin());
  command.back() = folder / "again.png";
  ASSERT_EQ(penumbra(command).status, 0);
  EXPECT_EQ(read_png(folder / "again.png").data, read_png(out + "/pictures/parker.png").data);
}

TEST_F(Compare, KeepsTheReference) {
  ASSERT_EQ(compare({"--shadows", "hard"}).status, 0);
  const Json::Value first = results();
  EXPECT_FALSE(first["reference"]["cached"].asBool());
  ASSERT_EQ(compare({"--shadows", "hard"}).status, 0);
  const Json::Value second = results();
  EXPECT_TRUE(second["reference"]["cached"].asBool());
  EXPECT_EQ(first["methods"][0]["error"], second["methods"][0]["error"]);
  ASSERT_EQ(compare({"--shadows", "hard", "--light-size", "2"}).status, 0);
  EXPECT_FALSE(results()["reference"]["cached"].asBool());
}

TEST_F(Compare, MakesADamagedReferenceAgainAndSaysSo) {
  ASSERT_EQ(compare({"--shadows", "hard"}).status, 0);
  const Json::Value first = results();
  std::string bytes = read_file(out + "/reference.bin");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 16);
  write_file(out + "/reference.bin", bytes);
  const Outcome outcome = compare({"--shadows", "hard"});
  ASSERT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err, HasSubstr("penumbra: warning: " + out +
                                     "/reference.bin: the kept reference is damaged; it is made "
                                     "again\n"));
  EXPECT_FALSE(results()["reference"]["cached"].asBool());
  EXPECT_EQ(first["methods"][0]["error"], results()["methods"][0]["error"]);
}

TEST_F(Compare, GoesOnAfterCtrlC) {
  const std::vector<std::string> words{"compare",      scene,    "-o",        out,     "--shadows",
                                       "hard",         "--size", "1600x1200", "--spp", "1",
                                       "--light-size", "4",      "--repeats", "1"};
  Running running(PENUMBRA_PROGRAM, words);
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  ASSERT_EQ(kill(running.id(), SIGINT), 0);
  const Outcome stopped = running.outcome();
  ASSERT_EQ(stopped.status, 130) << stopped.err;
  EXPECT_FALSE(std::filesystem::exists(out + "/results.json"));
  ASSERT_TRUE(std::filesystem::exists(out + "/reference.bin"));
  Running again(PENUMBRA_PROGRAM, words);
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  ASSERT_EQ(kill(again.id(), SIGINT), 0);
  EXPECT_THAT(again.outcome().err, HasSubstr("the reference goes on where it was stopped, "));
}

TEST_F(Compare, SweepsLightSizeDistanceAndSamples) {
  const Outcome outcome = compare({"--shadows", "hard,area", "--sweep", "light-size=0.1..1:3",
                                   "--sweep", "samples=1..16:2", "--sweep", "distance=1..2:2"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json::Value found = results();
  expect_valid(found);
  ASSERT_EQ(found["sweeps"].size(), 3u);
  const Json::Value& size = found["sweeps"][0];
  EXPECT_EQ(size["parameter"], "light-size");
  ASSERT_EQ(size["values"].size(), 3u);
  // A small light's penumbra covers less: the error of hard over the whole picture grows.
  const Json::Value& hard = size["methods"][0]["rmse"];
  EXPECT_LT(hard[0].asDouble(), hard[1].asDouble());
  EXPECT_LT(hard[1].asDouble(), hard[2].asDouble());
  const Json::Value& samples = found["sweeps"][1];
  ASSERT_EQ(samples["methods"].size(), 1u);
  EXPECT_GT(samples["methods"][0]["penumbra_rmse"][0].asDouble(),
            3 * samples["methods"][0]["penumbra_rmse"][1].asDouble());
  EXPECT_THAT(outcome.out, HasSubstr("penumbra error by light-size"));
}

TEST_F(Compare, TellsWhyAMethodCannotRun) {
  write_file(scene, R"({"camera": {"position": [0, 2, 6], "look_at": [0, 0, 0]},
    "materials": {"m": {}},
    "objects": [{"type": "sdf", "material": "m", "root": {"op": "union", "children": [
      {"shape": "plane", "normal": [0, 1, 0], "offset": -1},
      {"shape": "sphere", "center": [0, 0, 0], "radius": 1}]}}],
    "lights": [{"type": "sphere", "position": [1, 5, 1], "radius": 0.5, "radiance": [9, 9, 9]}]})");
  const Outcome outcome = compare({"--shadows", "hard,parker,sdf-inner", "--size", "32x24"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json::Value found = results();
  expect_valid(found);
  const Json::Value parker = method(found, "parker");
  EXPECT_EQ(parker["status"], "failed");
  EXPECT_THAT(parker["reason"].asString(), HasSubstr("has no end"));
  EXPECT_TRUE(parker["cost"].isNull());
  EXPECT_FALSE(std::filesystem::exists(out + "/pictures/parker.png"));
  EXPECT_THAT(outcome.out, HasSubstr("parker          could not run: "));
  EXPECT_EQ(method(found, "sdf-inner")["status"], "ok");
}

TEST_F(Compare, TellsWhereThereIsNoDriver) {
  std::vector<std::string> words{"compare", scene,      "-o", out,      "--shadows",
                                 "hard",    "--device", "gl", "--size", "32x24"};
  const Outcome outcome =
      penumbra(words, [] { setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", 1); });
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json::Value hard = method(results(), "hard");
  EXPECT_EQ(hard["status"], "failed");
  EXPECT_NE(hard["reason"].asString(), "");
  EXPECT_EQ(results()["advice"]["text"], "no method could be measured here");
}

struct Misuse {
  std::vector<std::string> options;
  std::string line;
};

class CompareMisuse : public SceneTest, public ::testing::WithParamInterface<Misuse> {};

TEST_P(CompareMisuse, IsRefusedInOneLine) {
  std::vector<std::string> words{"compare", scene, "-o", folder / "out", "--quiet"};
  words.insert(words.end(), GetParam().options.begin(), GetParam().options.end());
  expect_refused(penumbra(words), 2, GetParam().line);
  EXPECT_EQ(folder.count(), 1);
}

const std::string remedy_of_sweeps =
    "; write NAME=FIRST..LAST or NAME=FIRST..LAST:COUNT, as in light-size=0.01..1:5";

INSTANTIATE_TEST_SUITE_P(
    All, CompareMisuse,
    ::testing::Values(
        Misuse{{"--shadows", "hard,prker"},
               "--shadows: 'prker' is unknown; did you mean parker? There are hard, area, parker, "
               "heckbert-herf, sdf-classic, sdf-improved or sdf-inner"},
        Misuse{{"--shadows", "none"},
               "--shadows: 'none' is unknown; did you mean hard? There are hard, area, parker, "
               "heckbert-herf, sdf-classic, sdf-improved or sdf-inner"},
        Misuse{{"--shadows", "hard,hard"}, "--shadows: hard is named twice; name each method once"},
        Misuse{{"--sweep", "light-size"}, "--sweep light-size: there is no =" + remedy_of_sweeps},
        Misuse{{"--sweep", "light-size=1"},
               "--sweep light-size=1: there is no .." + remedy_of_sweeps},
        Misuse{{"--sweep", "light-size=0..1"},
               "--sweep light-size=0..1: 0 is not from 1e-06 to 1e+06" + remedy_of_sweeps},
        Misuse{{"--sweep", "light-size=a..1"},
               "--sweep light-size=a..1: 'a' is not a number" + remedy_of_sweeps},
        Misuse{{"--sweep", "light-size=1..1"},
               "--sweep light-size=1..1: both ends are the same" + remedy_of_sweeps},
        Misuse{{"--sweep", "light-size=1..2:1"},
               "--sweep light-size=1..2:1: '1' is not a whole number from 2 to 100" +
                   remedy_of_sweeps},
        Misuse{{"--sweep", "size=1..2"},
               "--sweep: 'size' is unknown; did you mean samples? There are light-size, distance "
               "or samples"},
        Misuse{{"--sweep", "distance=1..2", "--sweep", "distance=1..3"},
               "--sweep: distance is swept twice; sweep it once, with more values"},
        Misuse{{"--repeats", "0"},
               "--repeats: 0 is out of range; give a whole number from 1 to "
               "1000"}));

TEST_F(Compare, RefusesAFolderThatCannotBeBeforeAnyWork) {
  write_file(out, "a file");
  expect_refused(compare({"--quiet"}), 1,
                 out +
                     "/pictures: this folder cannot be made (Not a directory); choose another "
                     "folder with -o");
  EXPECT_EQ(read_file(out), "a file");
}

TEST_F(Compare, RefusesScenesWithoutLight) {
  expect_refused(compare({"--no-scene-lights", "--quiet"}), 2,
                 scene +
                     ": the scene has no light, so there is no shadow to compare; add one with "
                     "--light");
}

TEST_F(Compare, RefusesScenesWithoutAnythingToSee) {
  write_file(scene, R"({"objects": []})");
  expect_refused(
      compare({"--quiet"}), 2,
      scene + ": contains no triangle and no sphere; name a file with something to render");
  write_file(scene, R"({"objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1,
                                     "material": "m"}], "materials": {"m": {}},
                        "camera": {"position": [0, 0, 5], "look_at": [0, 0, 9]}})");
  expect_refused(compare({"--quiet"}), 2,
                 scene +
                     ": the camera sees no surface, so there is nothing to compare; choose "
                     "another with --camera");
}

TEST_F(Compare, RefusesToBeWithoutAFolder) {
  expect_refused(penumbra({"compare", scene}), 2, "no folder is named; add -o DIR");
}

TEST_F(Compare, ChoosesTheMethodOfRender) {
  const auto chosen = [&](const std::string& limit) {
    const Outcome outcome =
        penumbra({"render", scene, "-o", folder / "a.png", "--shadows", "auto", "--error", limit,
                  "--size", "64x48", "--stats", folder / "stats.json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("use "));
    return json_of(read_file(folder / "stats.json"))["chosen"];
  };
  const Json::Value strict = chosen("0.01");
  EXPECT_EQ(strict["method"], "area");
  EXPECT_NEAR(strict["error_limit"].asDouble(), 0.01, 1e-6);
  ASSERT_EQ(strict["candidates"].size(), 3u);
  const Json::Value lax = chosen("0.9");
  EXPECT_NE(lax["method"], "area");
  EXPECT_THAT(lax["text"].asString(), HasSubstr("penumbra error"));
}

}  // namespace
}  // namespace penumbra::test
