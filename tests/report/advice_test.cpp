#include "report/advice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace penumbra::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<Candidate> candidates{{"hard", 0.27, 0.1, {}},
                                        {"area", 0.05, 0.4, 20},
                                        {"parker", 0.5, 0.11, {}},
                                        {"sdf-inner", 0.03, 0.12, {}}};

TEST(Advice, IsTheFastestWithinTheLimit) {
  const Advice advice = advise(candidates, 0.05, true);
  EXPECT_EQ(advice.method, "sdf-inner");
  EXPECT_FALSE(advice.light_samples);
  EXPECT_EQ(advice.text,
            "use sdf-inner here: penumbra error 0.03 at 1.2 × the time of hard; area with 20 "
            "points would take 4 × the time of hard; hard, which is faster, errs by 0.27");
}

TEST(Advice, FollowsTheLimit) {
  EXPECT_EQ(advise(candidates, 0.3, true).method, "hard");
  EXPECT_EQ(advise(candidates, 0.6, true).method, "hard");
  const std::vector<Candidate> without_inner(candidates.begin(), candidates.end() - 1);
  const Advice area = advise(without_inner, 0.05, true);
  EXPECT_EQ(area.method, "area");
  EXPECT_EQ(area.light_samples, 20);
}

TEST(Advice, TakesTheNearestWhereNoneIsGoodEnough) {
  const Advice advice = advise(candidates, 0.01, true);
  EXPECT_EQ(advice.method, "sdf-inner");
  EXPECT_THAT(advice.text, HasSubstr("none keeps within 0.01"));
}

TEST(Advice, DoesWithoutHard) {
  const std::vector<Candidate> two{{"parker", 0.5, 0.2, {}}, {"sdf-inner", 0.03, 0.25, {}}};
  const Advice advice = advise(two, 0.05, true);
  EXPECT_EQ(advice.method, "sdf-inner");
  EXPECT_THAT(advice.text, HasSubstr("0.25 s a picture"));
  EXPECT_THAT(advice.text, Not(HasSubstr("time of hard")));
}

TEST(Advice, IsTheFastestWhereThereIsNoPenumbra) {
  const std::vector<Candidate> all{{"hard", 0, 0.2, {}}, {"parker", 0, 0.1, {}}};
  const Advice advice = advise(all, 0.05, false);
  EXPECT_EQ(advice.method, "parker");
  EXPECT_THAT(advice.text, HasSubstr("no pixel sees a part of a light alone"));
}

TEST(Advice, SaysThatThereIsNone) { EXPECT_EQ(advise({}, 0.05, true).method, ""); }

}  // namespace
}  // namespace penumbra::report
