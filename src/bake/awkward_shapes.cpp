#include "bake/awkward_shapes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "bake/barycentric.h"
#include "bake/clip.h"
#include "bake/raster_kernels.h"

namespace penumbra::bake {
namespace {

/// How far beyond the raster polygons are cut, texels.
constexpr double margin = 2;

struct Span {
  int first = 0, last = -1;
};

/// The part of a projected polygon in front of the sample and near the raster, in texels.
ClipPolygon in_texels(const SampleView& view, ClipPolygon p, const BitRaster& raster) {
  for (int i = 0; i < p.count; ++i) p.corners[i] = view.projection(p.corners[i]);
  const double right = raster.width() - 1 + margin, top = raster.height() - 1 + margin;
  clip(p, [&](const Vec3d& v) { return v.z - view.least_w; });
  clip(p, [&](const Vec3d& v) { return v.x + margin * v.z; });
  clip(p, [&](const Vec3d& v) { return v.y + margin * v.z; });
  clip(p, [&](const Vec3d& v) { return right * v.z - v.x; });
  clip(p, [&](const Vec3d& v) { return top * v.z - v.y; });
  for (int i = 0; i < p.count; ++i)
    p.corners[i] = {p.corners[i].x / p.corners[i].z, p.corners[i].y / p.corners[i].z, 0};
  return p;
}

/// Calls row(j, first, last) for the rows whose texel centres are in a convex polygon.
template <class Row>
void scan(const ClipPolygon& p, int height, const Row& row) {
  if (p.count < 3) return;
  double low = p.corners[0].y, high = low;
  for (int i = 1; i < p.count; ++i) {
    low = std::min(low, p.corners[i].y);
    high = std::max(high, p.corners[i].y);
  }
  const int first = std::max(0, static_cast<int>(std::ceil(low - edge_slack)));
  const int last = std::min(height - 1, static_cast<int>(std::floor(high + edge_slack)));
  for (int j = first; j <= last; ++j) {
    const double y = std::clamp(static_cast<double>(j), low, high);
    double left = INFINITY, right = -INFINITY;
    for (int i = 0; i < p.count; ++i) {
      const Vec3d &a = p.corners[i], &b = p.corners[i + 1 < p.count ? i + 1 : 0];
      if (y < std::min(a.y, b.y) || y > std::max(a.y, b.y)) continue;
      const double t = a.y == b.y ? 0 : (y - a.y) / (b.y - a.y), x = a.x + t * (b.x - a.x);
      left = std::min({left, x, a.y == b.y ? b.x : x});
      right = std::max({right, x, a.y == b.y ? b.x : x});
    }
    if (left <= right)
      row(j, static_cast<int>(std::ceil(left - edge_slack)),
          static_cast<int>(std::floor(right + edge_slack)));
  }
}

/// Real roots of a i² + 2 b i + c, infinite where there are fewer than two.
struct Roots {
  double low, high;
};
std::optional<Roots> roots(double a, double b, double c) {
  const double d = b * b - a * c;
  if (!(d >= 0)) return std::nullopt;
  const double q = -(b + std::copysign(std::sqrt(d), b));
  const double u = a != 0 ? q / a : std::copysign(INFINITY, -b), v = q != 0 ? c / q : u;
  return Roots{std::min(u, v), std::max(u, v)};
}

/// A sphere between the texels of one tile and a sample.
class SphereShadow {
 public:
  SphereShadow(const SampleView& view, const Vec3& center, float radius)
      : view_(view),
        center_(center),
        radius2_(double(radius) * double(radius)),
        cut_(view.tile.height_of(center) < radius) {
    const Vec3d to_center = center_ - view.sample;
    holds_sample_ = !view.at_infinity && dot(to_center, to_center) <= radius2_;
  }

  void fill_row(int j, BitRaster& raster) const {
    if (holds_sample_) return fill(j, 0, raster.width() - 1, raster);
    const Vec3d texel = texel_at(0, j), step(view_.tile.step_x);
    // Along the row with e from texel to sample and g to the centre: (e · g)² ≥ e² (g² − R²), which
    // says that the line meets the sphere. As seen from the sample, with s = g − e its distance to
    // the centre, the same is (e · s)² ≥ e² (s² − R²), of the second degree in i.
    double a = 0, b = 0, c = 0, towards = 0, towards_step = 0;
    if (view_.at_infinity) {
      const Vec3d g = center_ - texel, &e = view_.sample;
      a = dot(step, e) * dot(step, e) - dot(e, e) * dot(step, step);
      b = -dot(g, e) * dot(step, e) + dot(e, e) * dot(g, step);
      c = dot(g, e) * dot(g, e) - dot(e, e) * (dot(g, g) - radius2_);
      towards = 1;
    } else {
      const Vec3d d = texel - view_.sample, s = center_ - view_.sample;
      const double power = dot(s, s) - radius2_;
      towards = dot(d, s), towards_step = dot(step, s);
      a = towards_step * towards_step - dot(step, step) * power;
      b = towards * towards_step - dot(d, step) * power;
      c = towards * towards - dot(d, d) * power;
    }
    const auto r = roots(a, b, c);
    const auto faces = [&](double i) { return towards + towards_step * i > 0; };
    const int last = raster.width() - 1;
    if (!r) {
      if (a > 0 && faces(0)) fill(j, 0, last, raster);
      return;
    }
    const int low = to_int(std::ceil(a < 0 ? r->low : r->high));
    const int high = to_int(std::floor(a < 0 ? r->high : r->low));
    if (a < 0) {
      if (low <= high && faces(0.5 * (r->low + r->high))) fill(j, low, high, raster);
      return;
    }
    // Two branches of a hyperbola, of which one is the shadow.
    if (faces(r->high + 1)) fill(j, low, last, raster);
    if (faces(r->low - 1)) fill(j, 0, high, raster);
  }

 private:
  static int to_int(double x) { return static_cast<int>(std::clamp(x, -1e9, 1e9)); }

  Vec3d texel_at(int i, int j) const {
    const Tile& t = view_.tile;
    return Vec3d(t.origin) + Vec3d(t.step_x) * double(i) + Vec3d(t.step_y) * double(j);
  }

  void fill(int j, int first, int last, BitRaster& raster) const {
    if (!cut_) return raster.fill_cut(j, first, last);
    for (int i = std::max(first, 0); i <= std::min(last, raster.width() - 1); ++i)
      if (surface_is_above(texel_at(i, j))) raster.set(i, j);
  }

  /// Of a line that meets the sphere: whether it does so between the receiver and the sample. From
  /// inside the sphere it does unless the sample is inside too, from outside if the centre is
  /// ahead.
  bool surface_is_above(const Vec3d& texel) const {
    const Vec3d g = center_ - texel;
    if (dot(g, g) < radius2_) return !holds_sample_;
    return dot(g, view_.at_infinity ? view_.sample : view_.sample - texel) > 0;
  }

  const SampleView& view_;
  Vec3d center_;
  double radius2_;
  bool cut_;  ///< by the receiver's plane
  bool holds_sample_ = false;
};

}  // namespace

void draw_triangle(const SampleView& view, const Vec3 corner[3], BitRaster& raster) {
  const ClipPolygon p{3, {Vec3d(corner[0]), Vec3d(corner[1]), Vec3d(corner[2])}};
  scan(in_texels(view, p, raster), raster.height(),
       [&](int j, int first, int last) { raster.fill_cut(j, first, last); });
}

void draw_masked(const SampleView& view, const MaskedTriangle& triangle, const MaskedMesh& mask,
                 float receiver_epsilon, BitRaster& raster) {
  const Tile& tile = view.tile;
  const Vec3d a(triangle.corner[0]), b(triangle.corner[1]), c(triangle.corner[2]);
  const Vec3d normal = cross(b - a, c - a), up(tile.normal), origin(tile.origin);
  ClipPolygon p{3, {a, b, c}};
  if (std::min({dot(up, a - origin), dot(up, b - origin), dot(up, c - origin)}) <
      -double(receiver_epsilon))
    clip(p, [&](const Vec3d& v) { return dot(up, v - origin); });
  const auto is_opaque = [&](int i, int j) {
    const Vec3d texel = origin + Vec3d(tile.step_x) * double(i) + Vec3d(tile.step_y) * double(j);
    const Vec3d to = view.at_infinity ? view.sample : view.sample - texel;
    const double along = dot(normal, to);
    if (along == 0) return false;
    const Vec2 at = barycentric(a, b, c, texel + to * (dot(normal, a - texel) / along));
    return mask.distance(triangle.triangle, at.x, at.y) <= 0;
  };
  scan(in_texels(view, p, raster), raster.height(), [&](int j, int first, int last) {
    for (int i = std::max(first, 0); i <= std::min(last, raster.width() - 1); ++i)
      if (!raster.at(i, j) && is_opaque(i, j)) raster.set(i, j);
  });
}

void draw_sphere(const SampleView& view, const Vec3& center, float radius, BitRaster& raster) {
  const SphereShadow shadow(view, center, radius);
  for (int j = 0; j < raster.height(); ++j) shadow.fill_row(j, raster);
}

}  // namespace penumbra::bake
