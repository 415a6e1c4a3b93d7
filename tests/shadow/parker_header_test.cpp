// The header to take home, against the paper's formulas and against looking at many points.
#include <gtest/gtest.h>
#include <penumbra/parker.h>

#include <random>

#include "geometry/brute_force.h"

namespace penumbra {
namespace {

using Random = std::mt19937;

float uniform(Random& random, float lo, float hi) {
  return lo + (hi - lo) * static_cast<float>(random() >> 8) * 0x1p-24f;
}
Vec3 point(Random& random, float size) {
  return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}
Vec3 direction(Random& random) {
  for (;;)
    if (const Vec3 p = point(random, 1); dot(p, p) < 1 && dot(p, p) > 0.01f) return normalize(p);
}
// A unit vector that leans towards v, often by little.
Vec3 leaning(Random& random, const Vec3& v) {
  const Vec3 d = direction(random);
  return normalize(d - v * dot(d, v) + v * uniform(random, 0.02f, 0.5f));
}
parker::Vec plain(const Vec3& v) { return {v.x, v.y, v.z}; }

// A ray, the plane through its origin that it leaves, and the plane of a flat light at its end.
struct Query {
  Vec3 o, v, n, m;
  float distance;
  explicit Query(Random& random)
      : o(point(random, 1)),
        v(direction(random)),
        n(leaning(random, v)),
        m(leaning(random, -v)),
        distance(uniform(random, 1, 4)) {}

  parker::ShadowRay ray() const { return {plain(o), plain(v), distance, 0.5f}; }
  parker::HalfSpace above() const { return {plain(n), dot(n, o)}; }
  parker::HalfSpace before() const { return {plain(m), dot(m, o + v * distance)}; }
  bool keeps(const Vec3& p) const { return dot(n, p - o) > 0 && dot(m, p - o - v * distance) > 0; }
};

TEST(ParkerHeader, SphereTauIsTheAppendixs) {
  Random random(21);
  int between = 0;
  for (int i = 0; i < 5000; ++i) {
    const Query q(random);
    const Vec3 c = q.o + point(random, 2);
    const float radius = uniform(random, 0.05f, 0.5f);
    const Vec3d oc(c - q.o), v(q.v);
    const double t0 = dot(oc, v), d = length(oc - v * t0), b = 0.5 * t0;
    if (t0 > q.distance - radius || std::abs(t0) < radius) continue;
    const double tau = t0 < 0 ? 1 : std::clamp((d - radius) / b, 0.0, 1.0);
    between += tau > 0 && tau < 1;
    ASSERT_NEAR(parker::sphere_tau(q.ray(), plain(c), radius), tau, 1e-4) << "sphere " << i;
  }
  EXPECT_GT(between, 200);
}

TEST(ParkerHeader, ASphereBlocksOnlyBetweenPointAndLight) {
  const parker::ShadowRay ray{{0, 0, 0}, {0, 0, 1}, 4, 0.5f};
  const auto clearance = [&](float z, float radius) {
    return parker::sphere_clearance(ray, {0.1f, 0, z}, radius);
  };
  EXPECT_EQ(clearance(2, 1), 0);
  EXPECT_EQ(clearance(-0.5f, 1), 0) << "its centre is behind the point";
  EXPECT_EQ(clearance(4.5f, 1), 0) << "its centre is behind the light";
  EXPECT_EQ(clearance(-2, 1), parker::clear);
  EXPECT_EQ(clearance(6, 1), parker::clear);
  EXPECT_EQ(parker::sphere_clearance(ray, {1.5f, 0, 6}, 1), parker::clear);
}

TEST(ParkerHeader, OfASphereThatCrossesPlanesTheRestCounts) {
  // By looking at points of the sphere at the distance of its centre, or at the light's.
  Random random(22);
  int clipped = 0, gone = 0, missed = 0;
  for (int i = 0; i < 1500; ++i) {
    const Query q(random);
    const float radius = uniform(random, 0.1f, 0.8f),
                t = uniform(random, 0.2f, q.distance + radius);
    const Frame frame = frame_around(q.v);
    const float turn = uniform(random, 0, 6.2832f), away = radius * uniform(random, 1.05f, 2);
    const Vec3 across = frame.u * std::cos(turn) + frame.v * std::sin(turn);
    const Vec3 c = q.o + q.v * t + across * away;
    const float foot = std::min(t, q.distance);
    const float found = parker::sphere_clearance(q.ray(), plain(c), radius, q.above(), q.before());
    double least = INFINITY;
    constexpr int rings = 60, spokes = 120;
    for (int r = 0; r <= rings; ++r)
      for (int s = 0; s < spokes; ++s) {
        const float a = 6.2831853f * static_cast<float>(s) / spokes;
        const float k = radius * static_cast<float>(r) / rings;
        const Vec3 p =
            c - q.v * (t - foot) + frame.u * (k * std::cos(a)) + frame.v * (k * std::sin(a));
        if (q.keeps(p) && length(p - c) < radius)
          least = std::min<double>(least, length(p - q.o - q.v * foot) / foot);
      }
    const float grain = 0.06f * radius / foot;
    const float whole = (away - radius) / foot;
    clipped += least > whole + grain && std::isfinite(least), gone += std::isinf(least);
    if (std::isinf(least)) continue;  // or too small a rest to be looked at
    ASSERT_LE(found, least + 1e-4) << "sphere " << i;
    missed += found < least - grain;
  }
  EXPECT_GT(clipped, 60);
  EXPECT_GT(gone, 5);
  EXPECT_LT(missed, 15) << "pointed rests that fall between the points";
}

TEST(ParkerHeader, ASphereBelowThePlaneDoesNotCount) {
  const parker::ShadowRay ray{{0, 0, 0}, {0, 0, 1}, 4, 0.5f};
  const parker::HalfSpace above{{-1, 0, 0.2f}, 0}, before{{0, 0.2f, -1}, -4};
  EXPECT_EQ(parker::sphere_clearance(ray, {3, 0, 1}, 1, above), parker::clear);
  EXPECT_EQ(parker::sphere_clearance(ray, {0, -9, 3}, 1, above, before), parker::clear);
  EXPECT_NEAR(parker::sphere_clearance(ray, {-3, 0, 1}, 1, above), 2, 1e-5f);
}

TEST(ParkerHeader, TriangleClearanceAgreesWithBruteForce) {
  Random random(23);
  int between = 0, blocked = 0;
  for (int i = 0; i < 5000; ++i) {
    const Query q(random);
    const Vec3 center = q.o + point(random, 1.5f);
    const Vec3 a = center + point(random, 1), b = center + point(random, 1),
               c = center + point(random, 1);
    ConeQuery cone;
    cone.origin = q.o, cone.direction = q.v, cone.horizon = q.n, cone.distance = q.distance;
    cone.has_plane = true, cone.plane_normal = q.m;
    cone.plane_distance = -dot(q.m, q.v) * q.distance;
    const double truth = testing::polygon_clearance({Vec3d(a), Vec3d(b), Vec3d(c)}, cone);
    const float found =
        parker::triangle_clearance(q.ray(), plain(a), plain(b), plain(c), q.above(), q.before());
    between += truth > 0 && truth < 1, blocked += truth == 0;
    if (truth > 10) {
      ASSERT_GT(found, 9) << "triangle " << i;
    } else {
      ASSERT_NEAR(found, truth, 1e-4 * (1 + truth * truth)) << "triangle " << i;
    }
  }
  EXPECT_GT(between, 500);
  EXPECT_GT(blocked, 50);
}

TEST(ParkerHeader, ATriangleSeenEdgeOnBlocksOnlyWhatItReaches) {
  const parker::ShadowRay ray{{0, 0, 0}, {0, 0, 1}, 4, 0.5f};
  EXPECT_NEAR(parker::triangle_clearance(ray, {1, 0, 1}, {2, 0, 1}, {1, 0, 2}), 0.5f, 1e-6f);
  EXPECT_NEAR(parker::triangle_clearance(ray, {-1, 0, 1}, {2, 0, 1}, {1, 0, 2}), 0, 1e-6f);
}

TEST(ParkerHeader, TauOfALightWithoutExtentIsZeroOrOne) {
  const parker::ShadowRay ray{{0, 0, 0}, {0, 0, 1}, 4, 0};
  EXPECT_EQ(parker::tau(ray, 0), 0);
  EXPECT_EQ(parker::tau(ray, 1e-6f), 1);
  EXPECT_EQ(parker::tau(ray, parker::clear), 1);
  EXPECT_EQ(parker::triangle_tau(ray, {-1, -1, 2}, {1, -1, 2}, {0, 1, 2}), 0);
  EXPECT_EQ(parker::triangle_tau(ray, {-1, -1, 5}, {1, -1, 5}, {0, 1, 5}), 1);
}

TEST(ParkerHeader, ProfilesAndCompositesAreThePapers) {
  EXPECT_FLOAT_EQ(parker::cubic(0.25f), 0.15625f);
  EXPECT_NEAR(parker::sine(0.25f), 0.146447f, 1e-6f);
  EXPECT_EQ(parker::linear(0.25f), 0.25f);
  for (const auto profile : {parker::cubic, parker::sine, parker::linear}) {
    EXPECT_NEAR(profile(0), 0, 1e-7f);
    EXPECT_NEAR(profile(0.5f), 0.5f, 1e-6f);
    EXPECT_NEAR(profile(1), 1, 1e-7f);
  }
  EXPECT_EQ(parker::composite_min(0.75f, 0.5f), 0.5f);
  EXPECT_EQ(parker::composite_min(0.5f, 0.75f), 0.5f);
  EXPECT_EQ(parker::composite_multiply(0.75f, 0.5f), 0.375f);
  EXPECT_EQ(parker::composite_add(0.75f, 0.5f), 0.25f);
  EXPECT_EQ(parker::composite_add(0.25f, 0.5f), 0);
}

}  // namespace
}  // namespace penumbra
