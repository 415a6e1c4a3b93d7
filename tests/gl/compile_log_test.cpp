#include "gl/compile_log.h"

#include <gtest/gtest.h>

namespace penumbra::gl {
namespace {

TEST(CompileLog, ReadsMesa) {
  const auto m = parse_compile_log(
      "1:7(3): warning: `x' used uninitialized\n1:12(5): error: syntax error, unexpected ')'\n");
  ASSERT_EQ(m.size(), 2u);
  EXPECT_FALSE(m[0].error);
  EXPECT_TRUE(m[1].error);
  EXPECT_EQ(m[1].source, 1);
  EXPECT_EQ(m[1].line, 12);
  EXPECT_EQ(m[1].column, 5);
  EXPECT_EQ(m[1].text, "syntax error, unexpected ')'");
}

TEST(CompileLog, ReadsNvidia) {
  const auto m = parse_compile_log("1(12) : error C1503: undefined variable \"y\"\n");
  ASSERT_EQ(m.size(), 1u);
  EXPECT_TRUE(m[0].error);
  EXPECT_EQ(m[0].source, 1);
  EXPECT_EQ(m[0].line, 12);
  EXPECT_EQ(m[0].text, "C1503: undefined variable \"y\"");
}

TEST(CompileLog, ReadsGlslangAndItsKin) {
  const auto m = parse_compile_log("ERROR: 1:12: 'y' : undeclared identifier\r\n\0");
  ASSERT_EQ(m.size(), 1u);
  EXPECT_TRUE(m[0].error);
  EXPECT_EQ(m[0].source, 1);
  EXPECT_EQ(m[0].line, 12);
  EXPECT_EQ(m[0].text, "'y' : undeclared identifier");
}

TEST(CompileLog, LeavesOutTheRest) {
  EXPECT_TRUE(parse_compile_log("").empty());
  EXPECT_TRUE(parse_compile_log("3 errors generated.\n\n").empty());
  EXPECT_TRUE(parse_compile_log(std::string(100000, '1')).empty());
}

}  // namespace
}  // namespace penumbra::gl
