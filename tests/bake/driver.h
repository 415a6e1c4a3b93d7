// Tests that bake by OpenGL are skipped where there is no driver.
#pragma once

#include <gtest/gtest.h>

#include "bake/bake_options.h"
#include "base/error.h"
#include "gl/thread.h"

namespace penumbra::bake {

inline bool has_driver() {
  static const bool found = [] {
    try {
      const gl::Thread thread(gl::Profile::core);
      return true;
    } catch (const WorkError&) {
      return false;
    }
  }();
  return found;
}

/// A test that is run on several devices.
inline void skip_without_driver(BakeDevice device) {
  if (device == BakeDevice::gl && !has_driver())
    GTEST_SKIP() << "no OpenGL 4.5 driver that draws without a display";
}

inline std::string name_of(BakeDevice device) {
  return device == BakeDevice::cpu ? "OnCpu" : device == BakeDevice::gl ? "OnGl" : "ByRays";
}

}  // namespace penumbra::bake
