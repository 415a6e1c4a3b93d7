// Meshes with known distances, for the tests.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "scene/scene.h"

namespace penumbra::test {

inline Mesh mesh_of(std::vector<Vec3> positions, std::vector<std::uint32_t> indices) {
  Mesh mesh;
  mesh.name = "m";
  mesh.positions = std::move(positions);
  mesh.indices = std::move(indices);
  return mesh;
}

/// Quads of a grid of (u, v) in [0, 1]², wound so that ∂u × ∂v faces outwards.
inline Mesh surface_mesh(int columns, int rows, const std::function<Vec3d(double, double)>& at) {
  Mesh mesh = mesh_of({}, {});
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c)
      mesh.positions.push_back(
          Vec3(at(static_cast<double>(c % columns) / columns, static_cast<double>(r) / rows)));
  const auto vertex = [&](int c, int r) {
    return static_cast<std::uint32_t>(r * (columns + 1) + c);
  };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      for (const std::uint32_t v : {vertex(c, r), vertex(c + 1, r), vertex(c + 1, r + 1),
                                    vertex(c, r), vertex(c + 1, r + 1), vertex(c, r + 1)})
        mesh.indices.push_back(v);
  return mesh;
}

/// Triangles of zero area at the poles.
inline Mesh ball_mesh(double radius, int rows) {
  return surface_mesh(2 * rows, rows, [=](double u, double v) {
    const double a = 2 * std::numbers::pi * u, b = std::numbers::pi * (v - 0.5);
    const double ring = std::abs(v - 0.5) == 0.5 ? 0 : std::cos(b);
    return Vec3d(ring * std::cos(a), ring * -std::sin(a), std::sin(b)) * -radius;
  });
}

inline Mesh torus_mesh(double major, double minor, int columns, int rows) {
  return surface_mesh(columns, rows, [=](double u, double v) {
    const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * (v == 1 ? 0 : v);
    const double ring = major + minor * std::cos(b);
    return Vec3d(ring * std::cos(a), minor * std::sin(b), ring * -std::sin(a));
  });
}

/// 12 triangles facing outwards; sides are x−, x+, y−, y+, z−, z+, four triangles an axis.
inline Mesh box_mesh(const Vec3& lo, const Vec3& hi) {
  Mesh mesh = mesh_of({}, {});
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back({i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z});
  mesh.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                  2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
  return mesh;
}

inline void append(Mesh& mesh, const Mesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const std::uint32_t i : other.indices) mesh.indices.push_back(first + i);
}

inline Mesh scaled(Mesh mesh, float factor) {
  for (Vec3& p : mesh.positions) p = p * factor;
  return mesh;
}

inline double box_distance(const Vec3d& p, const Vec3d& lo, const Vec3d& hi) {
  const Vec3d q = abs(p - (lo + hi) * 0.5) - (hi - lo) * 0.5;
  return length(max(q, Vec3d(0))) + std::min(max_component(q), 0.0);
}

/// The unsigned distance to all triangles, one after another.
inline double brute_distance(const Mesh& mesh, const Vec3d& p) {
  double best = INFINITY;
  const auto to_segment = [&](const Vec3d& a, const Vec3d& b) {
    const double l = dot(b - a, b - a);
    const double t = l > 0 ? std::clamp(dot(p - a, b - a) / l, 0.0, 1.0) : 0;
    best = std::min(best, length(a + (b - a) * t - p));
  };
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3d a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
        c(mesh.positions[mesh.indices[i + 2]]);
    to_segment(a, b), to_segment(b, c), to_segment(c, a);
    const Vec3d n = cross(b - a, c - a);
    if (!(dot(n, n) > 0)) continue;
    const Vec3d q = p - n * (dot(n, p - a) / dot(n, n));
    if (dot(n, cross(b - a, q - a)) >= 0 && dot(n, cross(c - b, q - b)) >= 0 &&
        dot(n, cross(a - c, q - c)) >= 0)
      best = std::min(best, length(q - p));
  }
  return best;
}

/// The winding number, triangle by triangle (Van Oosterom and Strackee 1983).
inline double brute_winding(const Mesh& mesh, const Vec3d& p) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3d a = Vec3d(mesh.positions[mesh.indices[i]]) - p,
                b = Vec3d(mesh.positions[mesh.indices[i + 1]]) - p,
                c = Vec3d(mesh.positions[mesh.indices[i + 2]]) - p;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += std::atan2(dot(a, cross(b, c)),
                      la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (2 * std::numbers::pi);
}

inline std::vector<Vec3> points_about(const Vec3& center, float reach, std::size_t count,
                                      unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> coordinate(-reach, reach);
  std::vector<Vec3> points(count);
  for (Vec3& p : points)
    p = center + Vec3(coordinate(random), coordinate(random), coordinate(random));
  return points;
}

}  // namespace penumbra::test
