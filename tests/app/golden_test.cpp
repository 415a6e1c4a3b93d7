#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "app/golden.h"
#include "image/srgb.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace penumbra::test {
namespace {

Image rendered(const Golden& golden, const std::vector<std::string>& more) {
  const TemporaryFolder folder;
  const std::string file = folder / "candidate.png";
  std::vector<std::string> words = golden.command;
  words.insert(words.end(), {"-o", file});
  words.insert(words.end(), more.begin(), more.end());
  const Outcome outcome = penumbra(words);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.status == 0 ? read_rgb(file) : Image(96, 60, 3);
}

std::vector<Image> rendered_by_seeds(const Golden& golden, std::vector<std::string> more) {
  std::vector<Image> candidates;
  more.emplace_back("--seed");
  for (const char* seed : {"1", "2", "3", "4", "5", "6"}) {
    more.emplace_back(seed);
    candidates.push_back(rendered(golden, more));
    more.pop_back();
  }
  return candidates;
}

class GoldenTest : public ::testing::TestWithParam<Golden> {
 protected:
  // Fails, and leaves the pictures, if there is an objection.
  void judge(const std::string& objection, const Image& candidate, const Image& golden) {
    const std::string folder = failure_folder(GetParam().name);
    if (objection.empty())
      std::filesystem::remove_all(folder);
    else
      FAIL() << GetParam().name << ": " << objection << "; "
             << leave_pictures(folder, candidate, golden);
  }
};

std::string name_of(const ::testing::TestParamInfo<Golden>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

class Exact : public GoldenTest {};
TEST_P(Exact, IsTheGoldenPicture) {
  const Image golden = golden_picture(GetParam().name), candidate = rendered(GetParam(), {});
  judge(objection(candidate, golden), candidate, golden);
}
INSTANTIATE_TEST_SUITE_P(GoldenPictures, Exact, ::testing::ValuesIn(exact_pictures()), name_of);

class Sampled : public GoldenTest {};
TEST_P(Sampled, ScattersAboutTheGoldenPicture) {
  const Image golden = golden_picture(GetParam().name);
  const std::vector<Image> candidates = rendered_by_seeds(GetParam(), {});
  judge(statistical_objection(candidates, golden), mean_of(candidates), golden);
}
INSTANTIATE_TEST_SUITE_P(GoldenPictures, Sampled, ::testing::ValuesIn(sampled_pictures()), name_of);

Golden named(const std::vector<Golden>& all, const std::string& name) {
  for (const Golden& golden : all)
    if (golden.name == name) return golden;
  ADD_FAILURE() << name << " is in no list";
  return {};
}

TEST(GoldenPictures, SeeALightThatIsAFiftiethLarger) {
  for (const char* name : {"figure4-parker", "umbra-inner", "overlap-regular"})
    EXPECT_NE(objection(rendered(named(exact_pictures(), name), {"--light-size", "1.02"}),
                        golden_picture(name)),
              "")
        << name;
}

TEST(GoldenPictures, SeeThroughTheNoiseALightThatIsAFifthLarger) {
  for (const char* name : {"figure4-area", "overlap-area", "overlap-jittered"})
    EXPECT_NE(statistical_objection(
                  rendered_by_seeds(named(sampled_pictures(), name), {"--light-size", "1.2"}),
                  golden_picture(name)),
              "")
        << name;
}

Image ramp() {
  Image image(96, 60, 3);
  for (std::size_t i = 0; i < image.data.size(); ++i)
    image.data[i] =
        static_cast<float>(linear_from_srgb(static_cast<double>(i / 3 % 96 + 60) / 255));
  return image;
}

// Adds codes to all channels of a pixel.
void lighten(Image& image, int x, int y, double codes) {
  for (int c = 0; c < 3; ++c) {
    float& value = image.at(x, y)[c];
    value = static_cast<float>(linear_from_srgb(srgb_from_linear(value) + codes / 255));
  }
}

TEST(GoldenComparison, ForgivesRoundingAndAFewRays) {
  Image candidate = ramp();
  for (int y = 0; y < 60; ++y) lighten(candidate, y, y, y % 10 == 0 ? 1 : 0);
  for (int x = 0; x < 5; ++x) lighten(candidate, 10 * x, 7, 100);
  EXPECT_EQ(objection(candidate, ramp()), "");
}

TEST(GoldenComparison, ObjectsToManyRaysAndToAShift) {
  Image candidate = ramp();
  for (int x = 0; x < 6; ++x) lighten(candidate, 10 * x, 7, 100);
  EXPECT_THAT(objection(candidate, ramp()), ::testing::StartsWith("6 pixels are off"));
  candidate = ramp();
  for (int y = 0; y < 60; ++y)
    for (int x = 40; x < 50; ++x) lighten(candidate, x, y, 1);
  EXPECT_THAT(objection(candidate, ramp()), ::testing::StartsWith("0 pixels are off"));
  EXPECT_NE(objection(Image(95, 60, 3), ramp()), "");
}

TEST(GoldenComparison, ObjectsToABiasBeyondTheScatter) {
  const auto candidates = [](double bias) {
    std::vector<Image> all(6, ramp());
    for (int k = 0; k < 6; ++k)
      for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 30; ++x)
          lighten(all[k], x, y, bias + ((7 * x + 3 * y + 5 * k) % 6 - 2.5) * 4);
    return all;
  };
  EXPECT_EQ(statistical_objection(candidates(0), ramp()), "");
  EXPECT_NE(statistical_objection(candidates(8), ramp()), "");
}

TEST(GoldenComparison, LeavesThePicturesOfAFailure) {
  const TemporaryFolder folder;
  Image candidate = ramp();
  lighten(candidate, 30, 30, 100);
  const std::string place = folder / "deep/failure";
  EXPECT_THAT(leave_pictures(place, candidate, ramp()), ::testing::HasSubstr(place));
  EXPECT_NEAR(read_rgb(place + "/candidate.png").at(30, 30)[0], candidate.at(30, 30)[0], 0.01);
  EXPECT_NEAR(read_rgb(place + "/reference.png").at(30, 30)[0], ramp().at(30, 30)[0], 0.01);
  EXPECT_GT(read_rgb(place + "/difference.png").at(30, 30)[0], 0.01f);
}

}  // namespace
}  // namespace penumbra::test
