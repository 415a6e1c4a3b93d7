#include "bake/cut_charts.h"

#include <algorithm>

#include "bake/coplanar.h"
#include "bake/parallelogram.h"
#include "bake/smooth_regions.h"
#include "bake/texel_map.h"

namespace penumbra::bake {
namespace {

// Facets of less than 8 × 8 texels that have neighbours at a small angle are parts of something.
constexpr float facet_texels = 64;
constexpr float facet_cosine = 0.5f;

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
    shape.width = texels(length(p.edge_x), chart.texel_size, flat);
    shape.height = texels(length(p.edge_y), chart.texel_size, flat);
    return chart;
  }

  /// At least two along a side, four where the surface turns away within it.
  int texels(float metres, float size, bool flat) {
    const float count = std::ceil(metres / size);
    if (count > static_cast<float>(options_.most_texels)) remark(remarks_.coarse);
    return std::clamp(static_cast<int>(std::min(count, 1e6f)), flat ? 2 : 4, options_.most_texels);
  }

  /// That of the base-colour texture where this is finer, as far as allowed.
  float texel_size(const TriangleIds& triangles) {
    const Material& material = scene_.materials[mesh_.instance().material];
    const TextureSlot& slot = material.diffuse_map;
    if (!slot.used() || mesh_.mesh().uv[slot.uv_set].empty()) return options_.texel_size;
    const TextureImage& image = scene_.textures[static_cast<std::size_t>(slot.image)];
    if (image.width == 1 && image.height == 1) return options_.texel_size;
    double world = 0, texture = 0;
    for (const std::uint32_t t : triangles) world += mesh_.area(t), texture += uv_area(t, slot);
    texture *= std::abs(double{slot.scale.x} * slot.scale.y) * image.width * image.height;
    if (!(texture > 0)) return options_.texel_size;
    const auto wanted = static_cast<float>(std::sqrt(world / texture));
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

  double uv_area(std::uint32_t t, const TextureSlot& slot) const {
    const std::vector<Vec2>& uv = mesh_.mesh().uv[slot.uv_set];
    const Vec2 &a = uv[mesh_.vertex(t, 0)], &b = uv[mesh_.vertex(t, 1)],
               &c = uv[mesh_.vertex(t, 2)];
    return 0.5 *
           std::abs(static_cast<double>((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)));
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

}  // namespace

std::vector<CutChart> cut_charts(const Scene& scene, const WorldMesh& mesh,
                                 const Adjacency& adjacency, bool back, const ChartOptions& options,
                                 ChartRemarks& remarks) {
  return Cutter(scene, mesh, adjacency, back, options, remarks).cut();
}

}  // namespace penumbra::bake
