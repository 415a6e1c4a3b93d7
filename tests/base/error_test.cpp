#include "base/error.h"

#include <gtest/gtest.h>

#include <array>

#include "base/nearest_name.h"

namespace penumbra {
namespace {

TEST(Error, TellsPlaceFaultAndRemedyInOneLine) {
  EXPECT_STREQ(InputError({"a.json", 3, 7}, "bad", "mend it").what(), "a.json:3:7: bad; mend it");
  EXPECT_STREQ(InputError({"a.glb", 30}, "bad", "mend it").what(), "a.glb:30: bad; mend it");
  EXPECT_STREQ(InputError({"a.glb"}, "bad", "mend it").what(), "a.glb: bad; mend it");
  EXPECT_STREQ(WorkError("bad", "mend it").what(), "bad; mend it");
  EXPECT_STREQ(InputError({"a\nb"}, "c\td", "e\x1b[2J").what(), "a b: c d; e [2J");
}

TEST(NearestName, CountsEdits) {
  constexpr std::array<std::string_view, 4> names{"none", "hard", "area", "parker"};
  EXPECT_EQ(nearest_name("prker", names), "parker");
  EXPECT_EQ(nearest_name("hrad", names), "hard");
  EXPECT_EQ(nearest_name("aera", names), "area");
  EXPECT_EQ(nearest_name("", names), "none");
  EXPECT_EQ(nearest_name("x", {}), "");
}

}  // namespace
}  // namespace penumbra
