#include "sdf/mesher.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "sdf/distance_levels.h"
#include "sdf/quadric.h"
#include "sdf/surface_net.h"

namespace penumbra::sdf {
namespace {

constexpr double default_cells = 128;
constexpr float precision = 1e-5f;  // voxels: where Newton's method may stop
constexpr float stencil = 0.02f;    // voxels: of differences; finer would measure rounding
constexpr float reach = 1.5f;       // voxels that a vertex may go

/// Points in shares, each with a thread of its own.
template <class Body>
void for_shares(std::size_t count, const Body& body) {
  constexpr std::size_t share = 256;
  parallel_for((count + share - 1) / share,
               [&](std::size_t i) { body(i * share, std::min(count, (i + 1) * share)); });
}

/// The field cut by a box.
class Clipped {
 public:
  Clipped(const DistanceFunction& f, const Bounds& box) : f_(f), box_(box) {}
  void operator()(std::span<const Vec3> points, std::span<float> out) const {
    f_(points, out);
    for (std::size_t i = 0; i < points.size(); ++i)
      out[i] = std::max(out[i], max_component(max(box_.lo - points[i], points[i] - box_.hi)));
  }

 private:
  const DistanceFunction& f_;
  Bounds box_;
};

/// A tangent plane of the surface.
struct Tangent {
  Vec3 point, normal;
  float distance;  ///< f at the point
};

class Projector {
 public:
  Projector(const DistanceFunction& f, float voxel) : f_(f), voxel_(voxel) {}

  /// The points moved onto the surface along the gradient, with the normals there.
  void operator()(std::span<Tangent> tangents) const {
    for (int step = 0; step < 5; ++step) move(tangents, step);
    for (Tangent& t : tangents)
      if (std::abs(t.distance) > 1e-4f * voxel_) search(t);
  }

 private:
  struct Sample {
    float value;
    Vec3 gradient;
  };

  // Newton's method, by a voxel a step at most.
  void move(std::span<Tangent> tangents, int step) const {
    const std::vector<Sample> samples = sample(tangents);
    for (std::size_t i = 0; i < tangents.size(); ++i) {
      Tangent& t = tangents[i];
      const Sample& s = samples[i];
      const float slope2 = dot(s.gradient, s.gradient);
      t.distance = s.value;
      if (slope2 > 1e-12f) t.normal = s.gradient / std::sqrt(slope2);
      if (std::abs(s.value) < precision * voxel_ || !(slope2 > 1e-4f) || step == 4) continue;
      const Vec3 way = s.gradient * (-s.value / slope2);
      t.point += way * std::min(1.0f, voxel_ / (length(way) + 1e-30f));
    }
  }

  // Central differences.
  std::vector<Sample> sample(std::span<const Tangent> tangents) const {
    const float e = stencil * voxel_;
    std::vector<Vec3> points;
    points.reserve(7 * tangents.size());
    for (const Tangent& t : tangents) {
      points.push_back(t.point);
      for (int axis = 0; axis < 3; ++axis)
        for (const float side : {e, -e}) {
          points.push_back(t.point);
          points.back()[axis] += side;
        }
    }
    std::vector<float> f(points.size());
    f_(points, f);
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < f.size(); i += 7)
      samples.push_back(
          {f[i], Vec3(f[i + 1] - f[i + 2], f[i + 3] - f[i + 4], f[i + 5] - f[i + 6]) / (2 * e)});
    return samples;
  }

  // Where Newton's method found no zero: a change of sign along the normal, halved down to
  // rounding.
  void search(Tangent& t) const {
    constexpr int count = 33;
    std::array<Vec3, count> points;
    std::array<float, count> f;
    const auto at = [&](float s) { return t.point + t.normal * (s * voxel_); };
    for (int i = 0; i < count; ++i)
      points[static_cast<std::size_t>(i)] = at(reach * static_cast<float>(i - 16) / 16);
    f_(points, f);
    float lo = 0, hi = 0, nearest = INFINITY;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const float s = reach * (static_cast<float>(i) - 16) / 16;
      if ((f[i] < 0) == (f[i + 1] < 0) || std::abs(s) > nearest) continue;
      nearest = std::abs(s), lo = s, hi = s + reach / 16;
      if (!(f[i] < 0)) std::swap(lo, hi);
    }
    if (lo == hi) return;
    for (int step = 0; step < 24; ++step) {
      const float middle = 0.5f * (lo + hi);
      const Vec3 p = at(middle);
      f_({&p, 1}, {&t.distance, 1});
      (t.distance < 0 ? lo : hi) = middle;
    }
    t.point = at(0.5f * (lo + hi));
    f_({&t.point, 1}, {&t.distance, 1});
  }

  const DistanceFunction& f_;
  float voxel_;
};

std::vector<Tangent> tangents_at_faces(const SurfaceNet& net, const Projector& project) {
  std::vector<Tangent> tangents(net.faces.size());
  for (std::size_t i = 0; i < net.faces.size(); ++i)
    for (const std::uint32_t v : net.faces[i]) tangents[i].point += net.vertices[v] * 0.25f;
  for_shares(tangents.size(), [&](std::size_t begin, std::size_t end) {
    project(std::span(tangents).subspan(begin, end - begin));
  });
  return tangents;
}

// Each vertex to where the tangent planes of its faces meet.
void optimize(SurfaceNet& net, const Projector& project, float voxel) {
  const std::vector<Tangent> tangents = tangents_at_faces(net, project);
  std::vector<Quadric> quadrics(net.vertices.size());
  for (std::size_t i = 0; i < net.faces.size(); ++i) {
    const auto& face = net.faces[i];
    for (std::size_t k = 0; k < (face[2] == face[3] ? 3u : 4u); ++k)
      quadrics[face[k]].add(Vec3d(tangents[i].point - net.vertices[face[k]]),
                            Vec3d(tangents[i].normal));
  }
  std::vector<Tangent> moved(net.vertices.size());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Vec3 way(quadrics[i].minimum());
    moved[i].point = net.vertices[i];
    if (length(way) < reach * voxel) moved[i].point += way;
  }
  for_shares(moved.size(), [&](std::size_t begin, std::size_t end) {
    project(std::span(moved).subspan(begin, end - begin));
  });
  for (std::size_t i = 0; i < moved.size(); ++i) net.vertices[i] = moved[i].point;
}

// Quads are cut along the diagonal whose middle is nearer to the surface.
Mesh triangulated(const SurfaceNet& net, const DistanceFunction& f) {
  std::vector<Vec3> middles;
  for (const auto& q : net.faces)
    for (std::size_t k = 0; k < 2; ++k)
      middles.push_back((net.vertices[q[k]] + net.vertices[q[k + 2]]) * 0.5f);
  std::vector<float> d(middles.size());
  for_shares(middles.size(), [&](std::size_t begin, std::size_t end) {
    f(std::span(middles).subspan(begin, end - begin), std::span(d).subspan(begin, end - begin));
  });
  Mesh mesh;
  mesh.positions = net.vertices;
  for (std::size_t i = 0; i < net.faces.size(); ++i) {
    const auto& q = net.faces[i];
    const bool is_triangle = q[2] == q[3];
    const std::size_t k = is_triangle || std::abs(d[2 * i]) <= std::abs(d[2 * i + 1]) ? 0 : 1;
    for (const std::size_t c : {k, k + 1, k + 2}) mesh.indices.push_back(q[c & 3]);
    if (is_triangle) continue;
    for (const std::size_t c : {k, k + 2, k + 3}) mesh.indices.push_back(q[c & 3]);
  }
  return mesh;
}

void check(const Bounds& bounds) {
  if (bounds.empty() || !is_finite(bounds) || !(max_component(bounds.size()) > 0))
    throw InputError("a distance field can be turned into triangles in a finite box only",
                     "give one by --bounds x0,y0,z0,x1,y1,z1");
}

}  // namespace

Mesh mesh_of_field(const DistanceFunction& f, const Bounds& bounds, const MesherOptions& options) {
  check(bounds);
  const double side = max_component(bounds.size());
  const auto voxel = static_cast<float>(options.voxel_size.value_or(side / default_cells));
  const DistanceFunction clipped = Clipped(f, bounds);
  // Room for the sides of the bounds, and a start that is not on them.
  Bounds box = bounds;
  box.lo = box.lo - Vec3(2.37f, 2.61f, 2.43f) * voxel, box.hi = box.hi + Vec3(3 * voxel);
  SurfaceNet net;
  try {
    if (side / voxel > 1 << 20) throw GridTooLarge{};
    net = surface_net(clipped, box, voxel, options.most_bytes);
  } catch (const GridTooLarge&) {
    throw InputError(
        fmt::format("--voxel-size: triangles of a distance field of {:.3g} m by voxels "
                    "of {:.3g} m take more than {} MiB",
                    side, voxel, options.most_bytes >> 20),
        fmt::format("give larger ones, say --voxel-size {:.2g}", 2 * voxel));
  }
  optimize(net, Projector(clipped, voxel), voxel);
  return triangulated(net, clipped);
}

}  // namespace penumbra::sdf
