#include "bake/light_chart.h"

#include <algorithm>
#include <numeric>

#include "base/cancel.h"
#include "image/srgb.h"

namespace penumbra::bake {
namespace {

constexpr float reach = 1.5f;  // texels; bilinear filtering needs those next to the border

MeshPoint mesh_point(const TexelPlace& place, bool back) {
  return {place.triangle, place.b1, place.b2, back};
}

void compose(const CutChart& chart, const WorldMesh& mesh, const SurfaceLight& surface, bool masked,
             const LightOptions& options, ChartSamples& s) {
  const float width = chart.texel_size / static_cast<float>(options.supersample);
  if (masked) s.alphas.resize(s.places.size(), 1.0f);
  for (std::size_t i = 0; i < s.places.size(); ++i) {
    if (!s.places[i].is_used()) continue;
    const MeshPoint at = mesh_point(s.places[i], s.grid.back);
    if (options.quantity == Quantity::radiance)
      s.values[i] = surface.radiance(mesh, at, s.values[i], width);
    if (masked) s.alphas[i] = surface.alpha(mesh, at);
  }
}

/// The mean of those inside; where none is, of the nearest alone.
void average(const ChartSamples& s, int n, int x, int y, ChartTexels& out) {
  Vec3 sum, nearest;
  float alpha = 0, nearest_alpha = 0, count = 0, distance = INFINITY;
  for (int j = y * n; j < (y + 1) * n; ++j)
    for (int i = x * n; i < (x + 1) * n; ++i) {
      const std::size_t k = static_cast<std::size_t>(j) * static_cast<std::size_t>(s.grid.width) +
                            static_cast<std::size_t>(i);
      const TexelPlace& place = s.places[k];
      const float a = s.alphas.empty() ? 1.0f : s.alphas[k];
      if (place.is_inside()) sum += s.values[k], alpha += a, count += 1;
      if (place.is_used() && place.distance < distance)
        nearest = s.values[k], nearest_alpha = a, distance = place.distance;
    }
  const bool inside = count > 0;
  out.value.push_back(inside ? sum / count : nearest);
  if (!s.alphas.empty()) out.alpha.push_back(inside ? alpha / count : nearest_alpha);
  out.is_known.push_back(inside ? 2 : distance < INFINITY ? 1 : 0);
}

ChartTexels averaged(const ChartSamples& s, const PlanarChart& shape, int n) {
  ChartTexels out;
  for (int y = 0; y < shape.height; ++y)
    for (int x = 0; x < shape.width; ++x) average(s, n, x, y, out);
  return out;
}

/// Bilinear between known texels.
Vec3 sample(const ChartTexels& texels, const PlanarChart& shape, const Vec2& at) {
  const float x = std::clamp(at.x - 0.5f, 0.0f, static_cast<float>(shape.width - 1));
  const float y = std::clamp(at.y - 0.5f, 0.0f, static_cast<float>(shape.height - 1));
  Vec3 sum;
  float weight = 0;
  for (int k = 0; k < 4; ++k) {
    const int i = std::min(static_cast<int>(x) + k % 2, shape.width - 1);
    const int j = std::min(static_cast<int>(y) + k / 2, shape.height - 1);
    const float w = std::max(0.0f, 1 - std::abs(x - static_cast<float>(i))) *
                    std::max(0.0f, 1 - std::abs(y - static_cast<float>(j)));
    const auto index = static_cast<std::size_t>(j) * static_cast<std::size_t>(shape.width) +
                       static_cast<std::size_t>(i);
    if (!texels.is_known[index]) continue;
    sum += texels.value[index] * w, weight += w;
  }
  return weight > 0 ? sum / weight : sum;
}

std::vector<VertexColor> vertex_colors(const CutChart& chart, const WorldMesh& mesh,
                                       const ChartTexels& texels) {
  std::vector<VertexColor> colors;
  const ChartFrame frame(chart.shape);
  for (const std::uint32_t t : chart.shape.triangles)
    for (int k = 0; k < 3; ++k) colors.push_back({mesh.vertex(t, k), {}});
  std::ranges::sort(colors, {}, &VertexColor::vertex);
  const auto [first, last] = std::ranges::unique(colors, {}, &VertexColor::vertex);
  colors.erase(first, last);
  for (VertexColor& c : colors) c.color = sample(texels, chart.shape, frame.texels(mesh, c.vertex));
  return colors;
}

Vec3 displayed(const Vec3& radiance, float scale) {
  Vec3 code;
  for (int c = 0; c < 3; ++c)
    code[c] = static_cast<float>(
        srgb_from_linear(std::clamp(static_cast<double>(radiance[c] * scale), 0.0, 1.0)));
  return code;
}

bool is_like_vertices(const CutChart& chart, const WorldMesh& mesh, const ChartTexels& texels,
                      const std::vector<VertexColor>& colors, const LightOptions& options) {
  const float scale = std::exp2(options.exposure_ev), bound = *options.vertex_error / 255;
  const auto color = [&](std::uint32_t t, int k) -> const Vec3& {
    return std::ranges::lower_bound(colors, mesh.vertex(t, k), {}, &VertexColor::vertex)->color;
  };
  const std::vector<TexelPlace> places = map_texels(chart.shape, mesh, 0);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const TexelPlace& p = places[i];
    if (!p.is_inside()) continue;
    const Vec3 mixed = color(p.triangle, 0) * (1 - p.b1 - p.b2) + color(p.triangle, 1) * p.b1 +
                       color(p.triangle, 2) * p.b2;
    const Vec3 gap = abs(displayed(mixed, scale) - displayed(texels.value[i], scale));
    if (max_component(gap) > bound) return false;
  }
  return true;
}

/// The chart's plane at the mean height of its triangles, with all triangles of the mesh for its
/// own.
PlanarChart plane_through(const PlanarChart& chart, const WorldMesh& mesh) {
  PlanarChart plane = chart;
  double height = 0, area = 0;
  for (const std::uint32_t t : chart.triangles) {
    const Vec3 middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0f;
    height += mesh.area(t) * dot(chart.normal, middle - chart.base), area += mesh.area(t);
  }
  if (area > 0) plane.base += chart.normal * static_cast<float>(height / area);
  plane.triangles.resize(mesh.triangle_count());
  std::iota(plane.triangles.begin(), plane.triangles.end(), 0u);
  return plane;
}

}  // namespace

ChartSamples samples_of(const CutChart& chart, const WorldMesh& mesh, int supersample) {
  ChartSamples s;
  s.grid = chart.shape;
  s.grid.width *= supersample, s.grid.height *= supersample;
  s.places = map_texels(s.grid, mesh, reach * static_cast<float>(supersample), chart.apron);
  return s;
}

void find_irradiance(const CutChart& chart, const WorldMesh& mesh, const Irradiance& irradiance,
                     ChartSamples& s) {
  s.values.resize(s.places.size());
  if (chart.flat) irradiance.of_chart(s.grid, s.values);
  std::vector<SurfacePoint> points;
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < s.places.size(); ++i) {
    const TexelPlace& place = s.places[i];
    if (!place.is_used() || (chart.flat && place.is_inside())) continue;
    points.push_back(surface_point(mesh, mesh_point(place, s.grid.back)));
    which.push_back(i);
  }
  std::vector<Vec3> found(points.size());
  // What a mesh lays out itself is not seen along a normal.
  if (chart.flat || chart.shape.uv)
    irradiance.Irradiance::of_curved(s.grid, points, which, found);
  else
    irradiance.of_curved(plane_through(s.grid, mesh), points, which, found);
  for (std::size_t k = 0; k < which.size(); ++k) s.values[which[k]] = found[k];
}

LitChart compose_chart(const CutChart& chart, const WorldMesh& mesh, ChartSamples& samples,
                       const SurfaceLight& surface, const LightOptions& options) {
  const bool masked = surface.is_masked(mesh);
  compose(chart, mesh, surface, masked, options, samples);
  LitChart lit;
  lit.texels = averaged(samples, chart.shape, options.supersample);
  if (!options.vertex_error || masked) return lit;
  lit.vertices = vertex_colors(chart, mesh, lit.texels);
  // A vertex takes eight bytes, a texel three.
  const bool is_small = 8 * lit.vertices.size() < 3 * lit.texels.value.size();
  if (is_small && is_like_vertices(chart, mesh, lit.texels, lit.vertices, options))
    lit.texels = {};
  else
    lit.vertices.clear();
  return lit;
}

LitChart light_chart(const CutChart& chart, const WorldMesh& mesh, const Irradiance& irradiance,
                     const SurfaceLight& surface, const LightOptions& options) {
  ChartSamples samples = samples_of(chart, mesh, options.supersample);
  find_irradiance(chart, mesh, irradiance, samples);
  return compose_chart(chart, mesh, samples, surface, options);
}

}  // namespace penumbra::bake
