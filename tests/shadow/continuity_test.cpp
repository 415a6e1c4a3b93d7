// Nothing flickers: a small move changes every visible fraction by little.
#include <gtest/gtest.h>

#include <cmath>

#include "shadow/oracle.h"

namespace penumbra {
namespace {

using testing::Oracle;

std::vector<float> fractions(const Scene& scene, const Oracle& oracle, float tolerance) {
  const World world(scene);
  ShadowOptions options;
  options.tolerance = tolerance;
  const Shadows shadows(world, options);
  ShadowCounts counts;
  std::vector<float> out;
  for (std::size_t i = 0; i < oracle.points.size(); i += 3)
    out.push_back(shadows.visibility(oracle.points[i].receiver, 0, i, counts).fraction);
  return out;
}

constexpr float step = 0.002f;

// The profile's slope is at most 1.5 in τ = clearance · A / D. A move of the light turns the ray by
// at most step / A, and A itself changes by no more; the occluders are at most three times further
// from the light than from the floor.
float change_by_light(const Scene& scene) { return 1.5f * 3 * step / (2 * scene.lights[0].radius); }

// An occluder at distance t from the receiver moves by step / t in clearance. The sphere that moves
// is 0.58 above the floor at least, and the light less than 4.5 away.
float change_by_object(const Scene& scene) {
  return 1.5f * step / 0.58f * 4.5f / (2 * scene.lights[0].radius);
}

template <class Move>
void expect_no_jump(const std::string& name, float tolerance, float (*bound)(const Scene&),
                    const Move& move) {
  const Oracle oracle(name);
  std::vector<float> before;
  float moved = 0;
  for (int frame = 0; frame < 25; ++frame) {
    Scene scene = oracle.scene;
    move(scene, step * static_cast<float>(frame));
    const auto now = fractions(scene, oracle, tolerance);
    for (std::size_t i = 0; i < before.size(); ++i) {
      ASSERT_LE(std::abs(now[i] - before[i]), bound(scene) + tolerance)
          << name << " frame " << frame << " point " << i;
      moved += std::abs(now[i] - before[i]);
    }
    before = now;
  }
  EXPECT_GT(moved, 0.1f);  // the shadows did move
}

TEST(Continuity, MovingLight) {
  const auto move = [](Scene& scene, float by) {
    scene.lights[0].position += normalize(Vec3{1, 0.2f, -0.5f}) * by;
  };
  for (const float tolerance : {0.0f, 0.02f})
    for (const char* name : {"three-spheres", "bridge", "table"})
      expect_no_jump(name, tolerance, change_by_light, move);
}

TEST(Continuity, MovingObject) {
  const auto move = [](Scene& scene, float by) { scene.spheres[2].center += Vec3{by, 0, 0}; };
  for (const float tolerance : {0.0f, 0.02f})
    expect_no_jump("three-spheres", tolerance, change_by_object, move);
}

}  // namespace
}  // namespace penumbra
