// A folder with a small scene, for tests that run the program.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/atomic_file.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace penumbra::test {

/// A unit sphere above a floor at y = −1, a camera called front, and a sphere light called key
/// straight above.
class SceneTest : public ::testing::Test {
 protected:
  SceneTest() : scene(folder / "scene.json") {
    write_file(scene, R"({
      "cameras": {"front": {"position": [0, 2, 6], "look_at": [0, 0, 0]}},
      "materials": {"gray": {"diffuse": [0.5, 0.5, 0.5]}},
      "objects": [
        {"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "gray"},
        {"type": "quad", "corner": [-9, -1, 9], "edge_u": [18, 0, 0], "edge_v": [0, 0, -18],
         "material": "gray"}],
      "lights": [{"type": "sphere", "position": [0, 5, 0], "radius": 0.5,
                  "radiance": [9, 9, 9]}]})");
  }

  /// The program's own words: status and the one line on stderr.
  static void expect_refused(const Outcome& outcome, int status, const std::string& line) {
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_EQ(outcome.err, "penumbra: " + line + "\n");
    EXPECT_EQ(outcome.out, "");
  }

  TemporaryFolder folder;
  std::string scene;
};

}  // namespace penumbra::test
