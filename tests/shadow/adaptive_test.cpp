#include <gtest/gtest.h>

#include <cmath>

#include "shadow/adaptive_area.h"
#include "shadow/light_guard.h"
#include "shadow/oracle.h"

namespace penumbra {
namespace {

using testing::Oracle;

TEST(BitGrid, EdgesAreTheCellsThatDifferFromANeighbour) {
  BitGrid grid;
  grid.g = 8;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) grid.set(x, y, x + y > 6 && !(x == 7 && y == 7));
  const BitGrid edges = grid.edges();
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      bool differs = false;
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, 7); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, 7); ++u)
          differs = differs || grid.at(u, v) != grid.at(x, y);
      EXPECT_EQ(edges.at(x, y), differs) << x << ' ' << y;
    }
}

TEST(BitGrid, DoubledRepeatsEveryCellFourTimes) {
  BitGrid grid;
  grid.g = 32;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) grid.set(x, y, (x * 7 + y * 13) % 5 < 2);
  const BitGrid twice = grid.doubled();
  ASSERT_EQ(twice.g, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) ASSERT_EQ(twice.at(x, y), grid.at(x / 2, y / 2));
}

class Adaptive : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Adaptive, ::testing::Values("three-spheres", "bridge", "table"),
                         [](const auto& param) {
                           std::string name = param.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST_P(Adaptive, ErrorStaysBelowWhatIsAskedForWithFewerRays) {
  const Oracle oracle(GetParam());
  const World world(oracle.scene);
  double rays_before = 0;
  for (const float error : {0.03f, 0.01f, 0.003f}) {
    ShadowOptions options;
    options.kind = ShadowKind::area;
    options.error = error;
    const Shadows shadows(world, options);
    ShadowCounts counts;
    double squares = 0, estimates = 0;
    int n = 0;
    for (std::size_t i = 0; i < oracle.points.size(); ++i) {
      const auto& p = oracle.points[i];
      const Visibility seen = shadows.visibility(p.receiver, p.light, i, counts);
      if (p.truth < 0.002 || p.truth > 0.998) continue;
      squares += std::pow(seen.fraction - p.truth, 2), estimates += seen.standard_error, ++n;
      ASSERT_LE(seen.standard_error, error) << "point " << i;
    }
    EXPECT_LT(std::sqrt(squares / n), error + 0.001);
    EXPECT_GT(estimates / n, 0);
    const double rays =
        static_cast<double>(counts.rays) / static_cast<double>(oracle.points.size());
    // As many equal cells as the finest grid has would do the same without looking.
    EXPECT_LT(rays, 0.8 / (error * error));
    EXPECT_GT(rays, rays_before);
    rays_before = rays;
  }
}

TEST_P(Adaptive, ConeNeverCallsAShadowedPointLit) {
  const Oracle oracle(GetParam());
  const World world(oracle.scene);
  const LightViews lights(oracle.scene);
  int lit = 0;
  for (const auto& p : oracle.points) {
    ShadowCounts counts;
    if (!whole_light_is_seen(world, lights, p.receiver, p.light, counts)) continue;
    ++lit;
    EXPECT_GT(p.truth, 0.999);
  }
  EXPECT_GT(lit, 10);
}

TEST_P(Adaptive, GuardSparesRaysAndChangesNoAnswer) {
  const Oracle oracle(GetParam());
  const World world(oracle.scene);
  ShadowOptions options;
  options.kind = ShadowKind::area;
  const Shadows guarded(world, options);
  options.skip_lit = false;
  const Shadows traced(world, options);
  const Vec3 eye = oracle.scene.cameras.front().position, low = world.bounds().lo;
  const Vec3 size = world.bounds().size();
  int at_the_horizon = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const auto part = [&](int k) {
      return static_cast<float>(hash(i, 1) >> (20 * k) & 0xfffff) * 0x1p-20f;
    };
    const Vec3 inside = low + size * Vec3{part(0), part(1), part(2)};
    const Ray ray{eye, normalize(inside - eye)};
    const auto hit = world.intersect(ray);
    if (!hit) continue;
    const Receiver receiver = receiver_of(world.surface(ray, *hit));
    for (std::size_t light = 0; light < oracle.scene.lights.size(); ++light) {
      ShadowCounts with, without;
      const float fraction = guarded.visibility(receiver, light, i, with).fraction;
      ASSERT_EQ(fraction, traced.visibility(receiver, light, i, without).fraction) << i;
      at_the_horizon += fraction > 0 && fraction < 1 && with.rays == 0;
    }
  }
  EXPECT_GT(at_the_horizon, 10);
}

TEST_P(Adaptive, SameStreamSameAnswer) {
  const Oracle oracle(GetParam());
  const World world(oracle.scene);
  ShadowOptions options;
  options.kind = ShadowKind::area;
  options.error = 0.02f;
  const Shadows first(world, options), second(world, options);
  ShadowCounts counts;
  for (std::size_t i = 0; i < oracle.points.size(); i += 5) {
    const auto& p = oracle.points[i];
    EXPECT_EQ(first.visibility(p.receiver, p.light, i, counts).fraction,
              second.visibility(p.receiver, p.light, i, counts).fraction);
  }
}

}  // namespace
}  // namespace penumbra
