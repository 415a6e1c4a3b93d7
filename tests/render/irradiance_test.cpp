// Closed forms against the definition: ∫ max(cos θ, 0) dω, summed over a fine grid of the light.
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <vector>

#include "render/cone_irradiance.h"
#include "render/disk_irradiance.h"
#include "render/polygon_irradiance.h"
#include "render/segment_irradiance.h"

namespace penumbra {
namespace {

constexpr double pi = std::numbers::pi;

/// What one small piece of a surface at p, with area times its normal `da`, gives to n.
double piece(const Vec3d& p, const Vec3d& da, const Vec3d& n) {
  const double d2 = dot(p, p), facing = -dot(p, da);
  return facing > 0 ? std::max(0.0, dot(p, n)) * facing / (d2 * d2) : 0.0;
}

double brute_parallelogram(const Vec3& corner, const Vec3& u, const Vec3& v, const Vec3& n) {
  constexpr int steps = 600;
  const Vec3d da = cross(Vec3d(u), Vec3d(v)) / double(steps * steps);
  double sum = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j)
      sum += piece(Vec3d(corner) + Vec3d(u) * ((i + 0.5) / steps) + Vec3d(v) * ((j + 0.5) / steps),
                   da, Vec3d(n));
  return sum;
}

double brute_disk(const DiskView& disk, const Vec3& n) {
  constexpr int rings = 400, spokes = 1200;
  const Frame frame = frame_around(disk.normal);
  double sum = 0;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < spokes; ++j) {
      const double r = disk.radius * (i + 0.5) / rings, phi = 2 * pi * (j + 0.5) / spokes;
      const Vec3d p = Vec3d(disk.center) + Vec3d(frame.u) * (r * std::cos(phi)) +
                      Vec3d(frame.v) * (r * std::sin(phi));
      const double area = 2 * pi * r * disk.radius / rings / spokes;
      sum += piece(p, Vec3d(disk.normal) * area, Vec3d(n));
    }
  return sum;
}

double brute_cone(double cos_centre, double sin2) {
  constexpr int rings = 600, spokes = 1200;
  const double cos_edge = std::sqrt(1 - sin2), sin_centre = std::sqrt(1 - cos_centre * cos_centre);
  double sum = 0;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < spokes; ++j) {
      const double z = cos_edge + (1 - cos_edge) * (i + 0.5) / rings;
      const double x = std::sqrt(1 - z * z) * std::cos(2 * pi * (j + 0.5) / spokes);
      sum += std::max(0.0, z * cos_centre + x * sin_centre);
    }
  return sum * (1 - cos_edge) * 2 * pi / rings / spokes;
}

double brute_segment(const Vec3& a, const Vec3& b, double radius, const Vec3& n) {
  constexpr int steps = 200000;
  const Vec3d along = Vec3d(b) - Vec3d(a);
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const Vec3d p = Vec3d(a) + along * ((i + 0.5) / steps);
    const double d2 = dot(p, p);
    const double sine_dl = length(cross(p, along)) / std::sqrt(d2) / steps;
    sum += 2 * radius * std::max(0.0, dot(p, Vec3d(n))) / std::sqrt(d2) * sine_dl / d2;
  }
  return sum;
}

/// Normals from facing the light to turned well away from it.
std::vector<Vec3> tilted_normals() {
  std::vector<Vec3> normals;
  for (int i = 0; i <= 12; ++i) {
    const float tilt = 0.25f * static_cast<float>(i), turn = 0.9f * static_cast<float>(i);
    normals.push_back(
        {std::sin(tilt) * std::cos(turn), std::cos(tilt), std::sin(tilt) * std::sin(turn)});
  }
  return normals;
}

void expect_close(double value, double truth, double relative, double absolute) {
  EXPECT_NEAR(value, truth, relative * truth + absolute);
}

TEST(ConeIrradiance, IsTheIntegralAtEveryHeight) {
  for (double sin2 : {1e-4, 0.01, 0.25, 0.9})
    for (int i = -20; i <= 20; ++i) {
      const double cos_centre = std::sin(pi / 2 * i / 20);
      SCOPED_TRACE(testing::Message() << "sin² " << sin2 << ", cos " << cos_centre);
      expect_close(cone_irradiance(float(cos_centre), float(sin2), Horizon::exact),
                   brute_cone(cos_centre, sin2), 1e-3, 2e-4 * sin2);
    }
}

TEST(ConeIrradiance, SmallConeCrossingTheHorizonKeepsItsDigits) {
  // On the horizon a cone of half angle σ → 0 gives 2/3 σ³.
  for (double sigma : {1e-1, 1e-2, 1e-3, 1e-4})
    expect_close(cone_irradiance(0, float(std::pow(std::sin(sigma), 2)), Horizon::exact),
                 2.0 / 3.0 * std::pow(sigma, 3), 0.006, 0);
}

TEST(ConeIrradiance, TheCentreRuleFallsToZeroWithTheCentre) {
  EXPECT_EQ(cone_irradiance(0, 0.2f, Horizon::centre), 0);
  EXPECT_EQ(cone_irradiance(-0.1f, 0.2f, Horizon::centre), 0);
  EXPECT_EQ(cone_irradiance(0.7f, 0.2f, Horizon::centre),
            cone_irradiance(0.7f, 0.2f, Horizon::exact));
}

TEST(SphereIrradiance, FromInsideOrOnItIsFinite) {
  const Vec3 n{0, 1, 0};
  EXPECT_FLOAT_EQ(sphere_irradiance({0, 0, 0}, 1, n, Horizon::exact), float(pi));
  EXPECT_NEAR(sphere_irradiance({0, 0.5f, 0}, 1, n, Horizon::exact), pi, 1e-5);
  EXPECT_NEAR(sphere_irradiance({1, 0, 0}, 1, n, Horizon::exact), pi / 2, 1e-5);
  EXPECT_EQ(sphere_irradiance({0, 0, 0}, 0, n, Horizon::exact), 0);
}

TEST(PolygonIrradiance, IsTheIntegralAtEveryTilt) {
  const Vec3 corner{-0.4f, 0.8f, -0.7f}, u{1.2f, 0.3f, 0.1f}, v{0.1f, 0.2f, 1.1f};
  const std::array<Vec3, 4> quad{corner, corner + v, corner + u + v, corner + u};
  for (const Vec3& n : tilted_normals())
    expect_close(polygon_irradiance(quad, n, Horizon::exact),
                 brute_parallelogram(corner, u, v, n) + brute_parallelogram(corner, v, u, n), 1e-3,
                 2e-5);
}

TEST(PolygonIrradiance, TrianglesOfAQuadAddUp) {
  const std::array<Vec3, 4> q{Vec3{-1, 0.5f, -1}, {1, 0.5f, -1}, {1, 0.7f, 1}, {-1, 0.7f, 1}};
  const std::array<Vec3, 3> a{q[0], q[1], q[2]}, b{q[2], q[0], q[3]};
  for (const Vec3& n : tilted_normals())
    EXPECT_NEAR(polygon_irradiance(q, n, Horizon::exact),
                polygon_irradiance(a, n, Horizon::exact) + polygon_irradiance(b, n, Horizon::exact),
                2e-6);
}

TEST(PolygonIrradiance, DistantSmallPolygonIsCosinesOverSquaredDistance) {
  const float size = 1e-3f;
  const Vec3 corner{30, 40, 0};
  const std::array<Vec3, 4> quad{corner, corner + Vec3{size, 0, 0}, corner + Vec3{size, 0, size},
                                 corner + Vec3{0, 0, size}};
  const double truth = 1e-6 / 2500 * 0.8 * 0.8;
  EXPECT_NEAR(polygon_irradiance(quad, {0, 1, 0}, Horizon::exact) / truth, 1, 5e-3);
}

TEST(DiskIrradiance, IsTheIntegralAtEveryTilt) {
  const std::array<DiskView, 3> disks{
      DiskView{{0.7f, 0.9f, 0.3f}, normalize(Vec3{-0.3f, -1, 0.2f}), 0.6f},
      DiskView{{0, 1, 0}, {0, -1, 0}, 0.8f},
      DiskView{{0.1f, 0.2f, -0.2f}, normalize(Vec3{0.1f, -1, 0.4f}), 1.5f}};
  for (const DiskView& disk : disks)
    for (const Vec3& n : tilted_normals())
      expect_close(disk_irradiance(disk, n, Horizon::exact), brute_disk(disk, n), 1e-3, 2e-5);
}

TEST(DiskIrradiance, NothingBehindIt) {
  for (const Vec3& n : tilted_normals())
    EXPECT_EQ(disk_irradiance({{0, 1, 0}, {0, 1, 0}, 0.5f}, n, Horizon::exact), 0);
  EXPECT_EQ(disk_irradiance({{0, 0, 0}, {0, 1, 0}, 0.5f}, {0, 1, 0}, Horizon::exact), 0);
}

TEST(DiskIrradiance, IsContinuousWhereTheRimTouchesTheHorizon) {
  const DiskView disk{{2, 0.5f, 0}, {-1, 0, 0}, 0.5f};
  const float below = disk_irradiance(disk, normalize(Vec3{-1e-4f, 1, 0}), Horizon::exact);
  const float above = disk_irradiance(disk, normalize(Vec3{1e-4f, 1, 0}), Horizon::exact);
  EXPECT_NEAR(below, above, 1e-4);
}

TEST(SegmentIrradiance, IsTheIntegralAtEveryTilt) {
  const Vec3 a{-1.5f, 1, 0.4f}, b{0.8f, 0.6f, -0.3f};
  for (const Vec3& n : tilted_normals())
    expect_close(segment_irradiance(a, b, 0.02f, n, Horizon::exact), brute_segment(a, b, 0.02, n),
                 1e-4, 1e-7);
}

TEST(SegmentIrradiance, StaysFiniteOnTheLine) {
  const float e = segment_irradiance({-1, 0, 0}, {1, 0, 0}, 0.1f, {0, 1, 0}, Horizon::exact);
  EXPECT_GE(e, 0);
  EXPECT_LE(e, float(pi));
}

TEST(Irradiance, ScaleChangesNothing) {
  for (float s : {0.01f, 1.0f, 100.0f}) {
    SCOPED_TRACE(s);
    const Vec3 n = normalize(Vec3{0.3f, 1, 0.9f});
    const std::array<Vec3, 3> t{Vec3{0, 1, 0} * s, Vec3{1, 1, 0} * s, Vec3{0, 1.2f, 1} * s};
    const std::array<Vec3, 3> unit{Vec3{0, 1, 0}, {1, 1, 0}, {0, 1.2f, 1}};
    EXPECT_NEAR(
        polygon_irradiance(t, n, Horizon::exact) / polygon_irradiance(unit, n, Horizon::exact), 1,
        1e-5);
    EXPECT_NEAR(disk_irradiance({Vec3{0, 1, -1} * s, {0, -1, 0}, 0.5f * s}, n, Horizon::exact) /
                    disk_irradiance({{0, 1, -1}, {0, -1, 0}, 0.5f}, n, Horizon::exact),
                1, 1e-4);
    EXPECT_NEAR(
        segment_irradiance(Vec3{1, 1, 0} * s, Vec3{0, 1, 1} * s, 0.01f * s, n, Horizon::exact) /
            segment_irradiance({1, 1, 0}, {0, 1, 1}, 0.01f, n, Horizon::exact),
        1, 1e-4);
  }
}

}  // namespace
}  // namespace penumbra
