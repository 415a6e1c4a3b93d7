#include "bake/texel_map.h"

#include <algorithm>

namespace penumbra::bake {
namespace {

constexpr float inset = 1.0f / 64;  // texels

float cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }
Vec2 operator-(const Vec2& a, const Vec2& b) { return {a.x - b.x, a.y - b.y}; }

// A triangle of the chart in texels.
struct FlatTriangle {
  Vec2 corner[3];
  float doubled_area = 0;

  // Weights of corners 1 and 2; inside the triangle these and 1 − their sum are in [0, 1].
  Vec2 weights(const Vec2& p) const {
    const Vec2 d = p - corner[0];
    return {cross(d, corner[2] - corner[0]) / doubled_area,
            cross(corner[1] - corner[0], d) / doubled_area};
  }
};

FlatTriangle flat_triangle(const ChartFrame& frame, const WorldMesh& mesh, std::uint32_t t) {
  FlatTriangle flat;
  for (int k = 0; k < 3; ++k) flat.corner[k] = frame.texels(mesh, mesh.vertex(t, k));
  flat.doubled_area = cross(flat.corner[1] - flat.corner[0], flat.corner[2] - flat.corner[0]);
  return flat;
}

struct Place {
  Vec2 weights;
  float distance;
};

Place on_edge(const FlatTriangle& t, int k, const Vec2& p) {
  const Vec2 &a = t.corner[k], &b = t.corner[(k + 1) % 3];
  const Vec2 e = b - a, d = p - a;
  const float square = e.x * e.x + e.y * e.y;
  const float s = square > 0 ? std::clamp((d.x * e.x + d.y * e.y) / square, 0.0f, 1.0f) : 0.0f;
  Vec2 w{0, 0};
  float all[3] = {0, 0, 0};
  all[k] = 1 - s, all[(k + 1) % 3] = s;
  w = {all[1], all[2]};
  const Vec2 gap{d.x - e.x * s, d.y - e.y * s};
  return {w, std::sqrt(gap.x * gap.x + gap.y * gap.y)};
}

// Moved towards the centroid by `inset`, or onto it where the triangle is smaller than that.
Vec2 moved_in(const FlatTriangle& t, const Vec2& w) {
  const Vec2 to{1.0f / 3 - w.x, 1.0f / 3 - w.y};
  const Vec2 x = t.corner[1] - t.corner[0], y = t.corner[2] - t.corner[0];
  const float way = std::hypot(x.x * to.x + y.x * to.y, x.y * to.x + y.y * to.y);
  const float part = way > 0 ? std::min(1.0f, 2 * inset / way) : 1.0f;
  return {w.x + to.x * part, w.y + to.y * part};
}

Place nearest(const FlatTriangle& t, const Vec2& p) {
  if (t.doubled_area != 0) {
    const Vec2 w = t.weights(p);
    if (w.x >= 0 && w.y >= 0 && w.x + w.y <= 1) return {w, 0};
  }
  Place best{{}, INFINITY};
  for (int k = 0; k < 3; ++k)
    if (const Place place = on_edge(t, k, p); place.distance < best.distance) best = place;
  // Points on an edge that two triangles share are inside the chart.
  best.distance = std::max(best.distance, 1e-6f);
  best.weights = moved_in(t, best.weights);
  return best;
}

// Calls visit(texel, centre) for those whose centres are within `reach` of the triangle's box; of a
// chart without area, where coordinates are no numbers, for all.
template <class Visit>
void for_texels_near(const PlanarChart& chart, const FlatTriangle& t, float reach,
                     const Visit& visit) {
  const auto [x0, x1] = std::minmax({t.corner[0].x, t.corner[1].x, t.corner[2].x});
  const auto [y0, y1] = std::minmax({t.corner[0].y, t.corner[1].y, t.corner[2].y});
  const auto first = [&](float lo, int count) {
    const float at = std::min(static_cast<float>(count), std::max(0.0f, lo - reach - 0.5f));
    return static_cast<int>(std::ceil(at));
  };
  const auto last = [&](float hi, int count) {
    const float at = std::min(static_cast<float>(count - 1), hi + reach - 0.5f);
    return static_cast<int>(std::floor(std::max(-1.0f, at)));
  };
  for (int j = first(y0, chart.height); j <= last(y1, chart.height); ++j)
    for (int i = first(x0, chart.width); i <= last(x1, chart.width); ++i)
      visit(static_cast<std::size_t>(j) * static_cast<std::size_t>(chart.width) +
                static_cast<std::size_t>(i),
            Vec2{static_cast<float>(i) + 0.5f, static_cast<float>(j) + 0.5f});
}

std::size_t texel_count(const PlanarChart& chart) {
  return static_cast<std::size_t>(chart.width) * static_cast<std::size_t>(chart.height);
}

}  // namespace

ChartFrame::ChartFrame(const PlanarChart& chart)
    : uv_(chart.uv),
      base_(chart.base),
      width_(static_cast<float>(chart.width)),
      height_(static_cast<float>(chart.height)) {
  const Vec3d x(chart.edge_x), y(chart.edge_y), n = penumbra::cross(x, y);
  along_x_ = penumbra::cross(y, n) / dot(n, n);
  along_y_ = penumbra::cross(n, x) / dot(n, n);
}

Vec2 ChartFrame::coordinates(const Vec3& p) const {
  const Vec3d d = Vec3d(p) - base_;
  return {static_cast<float>(dot(d, along_x_)), static_cast<float>(dot(d, along_y_))};
}

Vec2 ChartFrame::texels(const Vec3& p) const {
  const Vec2 c = coordinates(p);
  return {c.x * width_, c.y * height_};
}

Vec2 ChartFrame::texels(const WorldMesh& mesh, std::uint32_t vertex) const {
  if (!uv_) return texels(mesh.positions()[vertex]);
  const Vec2 at = mesh.mesh().uv[uv_->set][vertex] - uv_->corner;
  return {at.x / uv_->size.x * width_, at.y / uv_->size.y * height_};
}

std::vector<TexelPlace> map_texels(const PlanarChart& chart, const WorldMesh& mesh, float reach,
                                   std::span<const std::uint32_t> apron) {
  const ChartFrame frame(chart);
  std::vector<TexelPlace> map(texel_count(chart));
  for (const std::uint32_t t : chart.triangles) {
    const FlatTriangle flat = flat_triangle(frame, mesh, t);
    for_texels_near(chart, flat, reach, [&](std::size_t i, const Vec2& centre) {
      TexelPlace& texel = map[i];
      if (texel.is_inside()) return;
      const Place place = nearest(flat, centre);
      if (place.distance < texel.distance && place.distance <= reach)
        texel = {t, place.weights.x, place.weights.y, place.distance};
    });
  }
  for (const std::uint32_t t : apron) {
    const FlatTriangle flat = flat_triangle(frame, mesh, t);
    for_texels_near(chart, flat, 0, [&](std::size_t i, const Vec2& centre) {
      if (map[i].is_inside() || !map[i].is_used()) return;
      const Place place = nearest(flat, centre);
      if (place.distance == 0) map[i] = {t, place.weights.x, place.weights.y, 0};
    });
  }
  return map;
}

std::vector<std::uint32_t> overlapping(const PlanarChart& chart, const WorldMesh& mesh) {
  const ChartFrame frame(chart);
  std::vector<bool> held(texel_count(chart));
  std::vector<std::uint32_t> over;
  std::vector<std::size_t> mine;
  for (const std::uint32_t t : chart.triangles) {
    const FlatTriangle flat = flat_triangle(frame, mesh, t);
    bool clash = false;
    mine.clear();
    for_texels_near(chart, flat, 0, [&](std::size_t i, const Vec2& centre) {
      if (flat.doubled_area == 0) return;
      const Vec2 w = flat.weights(centre);
      // Clear of the edges, which neighbours share.
      const float least = std::min({w.x, w.y, 1 - w.x - w.y});
      if (least < 1e-3f) return;
      clash |= held[i];
      mine.push_back(i);
    });
    if (clash)
      over.push_back(t);
    else
      for (const std::size_t i : mine) held[i] = true;
  }
  return over;
}

}  // namespace penumbra::bake
