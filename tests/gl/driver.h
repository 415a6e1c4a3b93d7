// Tests that draw: in child processes, as the program does; skipped where there is no driver.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <vector>

#include "base/error.h"
#include "gl/context.h"
#include "gl/guarded.h"

namespace penumbra::testing {

inline bool has_driver() {
  static const bool found = [] {
    Progress silent;
    try {
      gl::guarded(
          [](Progress&) {
            const gl::Context context;
            return std::string();
          },
          silent);
      return true;
    } catch (const WorkError&) {
      return false;
    }
  }();
  return found;
}

/// Floats made under a context of their own.
inline std::vector<float> drawn(const std::function<std::vector<float>()>& draw) {
  Progress silent;
  const std::string bytes = gl::guarded(
      [&](Progress&) {
        const gl::Context context;
        const std::vector<float> floats = draw();
        return std::string(reinterpret_cast<const char*>(floats.data()),
                           floats.size() * sizeof(float));
      },
      silent);
  std::vector<float> floats(bytes.size() / sizeof(float));
  std::memcpy(floats.data(), bytes.data(), bytes.size());
  return floats;
}

class GlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_driver()) GTEST_SKIP() << "no OpenGL driver that draws without a display";
  }
};

}  // namespace penumbra::testing
