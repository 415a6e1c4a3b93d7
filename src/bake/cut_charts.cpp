#include "bake/cut_charts.h"

#include <algorithm>
#include <unordered_map>

#include "bake/coplanar.h"
#include "bake/parallelogram.h"
#include "bake/smooth_regions.h"
#include "bake/texel_map.h"

namespace penumbra::bake {
namespace {

// Facets of less than 8 × 8 texels that have neighbours at a small angle are parts of something.
constexpr float facet_texels = 64;
constexpr float facet_cosine = 0.5f;
// Texels beyond the border of a curved chart that bilinear filtering reads, and how steeply the
// surface may be seen there.
constexpr float apron_texels = 1.5f;
constexpr float apron_cosine = 0.1f;

class Cutter {
 public:
  Cutter(const Scene& scene, const WorldMesh& mesh, const Adjacency& adjacency, bool back,
         const ChartOptions& options, ChartRemarks& remarks)
      : scene_(scene),
        mesh_(mesh),
        adjacency_(adjacency),
        back_(back),
        options_(options),
        remarks_(remarks) {}

  std::vector<CutChart> cut() {
    TriangleIds curved;
    std::vector<bool> planar(mesh_.triangle_count());
    for (const TriangleIds& part : coplanar_parts(mesh_, adjacency_)) {
      if (is_facet(part)) continue;
      for (const std::uint32_t t : part) planar[t] = true;
      add(part, mesh_.normal(part.front()), true);
    }
    for (std::uint32_t t = 0; t < planar.size(); ++t)
      if (!planar[t]) curved.push_back(t);
    const float least = facet_texels * options_.texel_size * options_.texel_size;
    for (const SmoothRegion& region : smooth_regions(mesh_, adjacency_, curved, least))
      add(region.triangles, region.axis, false);
    return std::move(charts_);
  }

 private:
  bool is_facet(const TriangleIds& part) const {
    float area = 0;
    for (const std::uint32_t t : part) area += mesh_.area(t);
    if (area >= facet_texels * options_.texel_size * options_.texel_size) return false;
    const Vec3& n = mesh_.normal(part.front());
    for (const std::uint32_t t : part)
      for (const std::uint32_t other : adjacency_.neighbours(t)) {
        const float cosine = dot(mesh_.normal(other), n);
        if (cosine > facet_cosine && cosine < 0.99999f) return true;
      }
    return false;
  }

  /// Curved charts that overlap leave what lies on top to further charts.
  void add(TriangleIds triangles, const Vec3& front, bool flat) {
    while (!triangles.empty()) {
      CutChart chart = fitted(triangles, front, flat);
      TriangleIds over;
      if (!flat) over = overlapping(chart.shape, mesh_);
      if (over.size() >= triangles.size()) over.clear();
      if (!over.empty()) {
        std::ranges::sort(over);
        std::erase_if(triangles,
                      [&](std::uint32_t t) { return std::ranges::binary_search(over, t); });
        chart = fitted(triangles, front, flat);
      }
      if (!flat) chart.apron = apron_of(chart, front);
      charts_.push_back(std::move(chart));
      triangles = std::move(over);
    }
  }

  CutChart fitted(const TriangleIds& triangles, const Vec3& front, bool flat) {
    CutChart chart;
    chart.flat = flat;
    PlanarChart& shape = chart.shape;
    shape.instance = mesh_.index();
    shape.triangles = triangles;
    shape.back = back_;
    shape.normal = back_ ? -front : front;
    std::vector<Vec3> corners;
    for (const std::uint32_t t : triangles)
      for (int k = 0; k < 3; ++k) corners.push_back(mesh_.corner(t, k));
    const Parallelogram p = fit_parallelogram(corners, shape.normal);
    shape.base = p.base, shape.edge_x = p.edge_x, shape.edge_y = p.edge_y;
    chart.half = p.half;
    chart.texel_size = texel_size(triangles);
    if (!flat) chart.texel_size = std::min(chart.texel_size, curved_texel_size(triangles));
    if (!flat) widen(chart);
    shape.width = texels(length(p.edge_x), chart.texel_size, flat);
    shape.height = texels(length(p.edge_y), chart.texel_size, flat);
    return chart;
  }

  /// By the apron, on all sides.
  static void widen(CutChart& chart) {
    PlanarChart& shape = chart.shape;
    const Vec3 x = normalize(shape.edge_x) * (apron_texels * chart.texel_size);
    const Vec3 y = normalize(shape.edge_y) * (apron_texels * chart.texel_size);
    shape.base = shape.base - x - y;
    shape.edge_x += x * 2.0f, shape.edge_y += y * 2.0f;
    chart.half = false;
  }

  /// Triangles that the surface reaches smoothly within the apron's width, measured from middle to
  /// middle, and the width of a triangle more.
  TriangleIds apron_of(const CutChart& chart, const Vec3& front) const {
    const float reach = 2 * apron_texels * chart.texel_size;
    TriangleIds found = chart.shape.triangles;
    std::unordered_map<std::uint32_t, float> way;
    for (const std::uint32_t t : found) way[t] = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const std::uint32_t from = found[i];
      for (const std::uint32_t t : adjacency_.neighbours(from)) {
        if (way.contains(t) || dot(mesh_.normal(t), front) < apron_cosine ||
            dot(mesh_.normal(t), mesh_.normal(from)) < facet_cosine)
          continue;
        const bool is_first = i < chart.shape.triangles.size();
        way[t] = is_first ? 0 : way[from] + length(middle(t) - middle(from));
        if (way[t] <= reach) found.push_back(t);
      }
    }
    found.erase(found.begin(),
                found.begin() + static_cast<std::ptrdiff_t>(chart.shape.triangles.size()));
    return found;
  }
  Vec3 middle(std::uint32_t t) const {
    return (mesh_.corner(t, 0) + mesh_.corner(t, 1) + mesh_.corner(t, 2)) / 3.0f;
  }

  /// At least two along a side, four where the surface turns away within it.
  int texels(float metres, float size, bool flat) {
    const float count = std::ceil(metres / size);
    if (count > static_cast<float>(options_.most_texels)) remark(remarks_.coarse);
    return std::clamp(static_cast<int>(std::min(count, 1e6f)), flat ? 2 : 4, options_.most_texels);
  }

  /// That of the base-colour texture where this is finer, as far as allowed.
  float texel_size(const TriangleIds& triangles) {
    const float wanted = base_color_texel(scene_, mesh_, triangles).value_or(options_.texel_size);
    if (wanted < options_.finest * options_.texel_size) remark(remarks_.blurred);
    return std::clamp(wanted, options_.finest * options_.texel_size, options_.texel_size);
  }

  /// So fine that the surface turns by 0.4 radians within a texel on average, but at least half of
  /// what was asked for: one point a texel would show a rounded edge in blotches.
  float curved_texel_size(const TriangleIds& triangles) const {
    double turn = 0, area = 0;
    for (const std::uint32_t t : triangles) {
      area += mesh_.area(t);
      for (const std::uint32_t n : adjacency_.neighbours(t)) {
        const double cosine = std::clamp(dot(mesh_.normal(t), mesh_.normal(n)), -1.0f, 1.0f);
        // Each edge is met from both of its sides.
        if (cosine > facet_cosine) turn += 0.5 * std::acos(cosine) * shared_edge(t, n);
      }
    }
    const auto wanted = static_cast<float>(0.4 * area / std::max(turn, 1e-30));
    return std::max(wanted, 0.5f * options_.texel_size);
  }

  /// Metres.
  float shared_edge(std::uint32_t a, std::uint32_t b) const {
    const auto is_corner = [&](const Vec3& p) {
      return p == mesh_.corner(b, 0) || p == mesh_.corner(b, 1) || p == mesh_.corner(b, 2);
    };
    for (int k = 0; k < 3; ++k) {
      const Vec3 &p = mesh_.corner(a, k), &q = mesh_.corner(a, (k + 1) % 3);
      if (is_corner(p) && is_corner(q)) return length(q - p);
    }
    return 0;
  }

  void remark(std::vector<std::string>& names) const {
    const std::string& name = scene_.objects[mesh_.instance().object].name;
    if (names.empty() || names.back() != name) names.push_back(name);
  }

  const Scene& scene_;
  const WorldMesh& mesh_;
  const Adjacency& adjacency_;
  bool back_;
  const ChartOptions& options_;
  ChartRemarks& remarks_;
  std::vector<CutChart> charts_;
};

double uv_area(const WorldMesh& mesh, std::uint32_t t, const std::vector<Vec2>& uv) {
  const Vec2 &a = uv[mesh.vertex(t, 0)], &b = uv[mesh.vertex(t, 1)], &c = uv[mesh.vertex(t, 2)];
  return 0.5 * std::abs(static_cast<double>((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)));
}

}  // namespace

std::optional<float> base_color_texel(const Scene& scene, const WorldMesh& mesh,
                                      std::span<const std::uint32_t> triangles) {
  const TextureSlot& slot = scene.materials[mesh.instance().material].diffuse_map;
  if (!slot.used() || mesh.mesh().uv[slot.uv_set].empty()) return {};
  const TextureImage& image = scene.textures[static_cast<std::size_t>(slot.image)];
  if (image.width == 1 && image.height == 1) return {};
  double world = 0, texture = 0;
  for (const std::uint32_t t : triangles) {
    world += mesh.area(t);
    texture += uv_area(mesh, t, mesh.mesh().uv[slot.uv_set]);
  }
  texture *= std::abs(double{slot.scale.x} * slot.scale.y) * image.width * image.height;
  if (!(texture > 0)) return {};
  return static_cast<float>(std::sqrt(world / texture));
}

std::vector<CutChart> cut_charts(const Scene& scene, const WorldMesh& mesh,
                                 const Adjacency& adjacency, bool back, const ChartOptions& options,
                                 ChartRemarks& remarks) {
  return Cutter(scene, mesh, adjacency, back, options, remarks).cut();
}

}  // namespace penumbra::bake
