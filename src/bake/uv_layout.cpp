#include "bake/uv_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "bake/coplanar.h"
#include "bake/parallelogram.h"
#include "bake/uv_overlap.h"
#include "base/error.h"

namespace penumbra::bake {
namespace {

constexpr float beyond = 1e-4f;             // of [0, 1], by rounding
constexpr float least_texels = 1.0f / 256;  // in a layout, of what is a texel or more in the world
constexpr double most_contested = 0.002;    // of a mesh's texels
constexpr float most_flat = 0.01f;          // of a mesh, without area in its layout
constexpr float affine_error = 1.0f / 64;   // texels
constexpr int most_flat_charts = 64;        // of a plane, laid out in as many ways
constexpr float reach = 2;                  // texels round a chart
constexpr int fewest_texels = 4;            // along a page

float cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }
Vec2 operator-(const Vec2& a, const Vec2& b) { return {a.x - b.x, a.y - b.y}; }

/// Meshes that share a page.
struct Sheet {
  std::vector<std::uint32_t> instances;
  int set = 0;
  Vec2 tile;
  AtlasPage page;
  float texel_size = 0;
};

/// How a plane is laid out: its texture coordinates are corner + (x · (p − origin), y · (p − …)).
struct FlatLayout {
  Vec3d origin, x, y, normal;
  Vec2 corner;
  Vec3d per_u, per_v;  ///< metres a unit of u, v

  Vec2 uv(const Vec3& p) const {
    const Vec3d d = Vec3d(p) - origin;
    return {corner.x + static_cast<float>(dot(x, d)), corner.y + static_cast<float>(dot(y, d))};
  }
  Vec3 point(const Vec2& at) const {
    return Vec3(origin + per_u * (double{at.x} - corner.x) + per_v * (double{at.y} - corner.y));
  }
};

class Layout {
 public:
  Layout(const Scene& scene, const std::vector<std::unique_ptr<Adjacency>>& adjacencies,
         const ChartOptions& options, bool power_of_two, Plan& plan)
      : scene_(scene),
        adjacencies_(adjacencies),
        options_(options),
        power_of_two_(power_of_two),
        plan_(plan) {}

  void run() {
    plan_.placed.emplace();
    for (Sheet& sheet : sheets())
      for (const bool back : {false, true}) add_page(sheet, back);
  }

 private:
  std::vector<Sheet> sheets() {
    std::map<std::uint32_t, Sheet> by_object;
    for (std::uint32_t i = 0; i < plan_.meshes.size(); ++i)
      if (plan_.receives[i] && plan_.meshes[i]->triangle_count() > 0)
        by_object[scene_.instances[i].object].instances.push_back(i);
    std::vector<Sheet> all;
    for (auto& [object, sheet] : by_object) {
      sheet.set = set_of(sheet);
      find_tile(sheet);
      size(sheet);
      if (is_shared_well(sheet)) {
        all.push_back(sheet);
        continue;
      }
      for (const std::uint32_t i : sheet.instances) {
        Sheet alone{{i}, sheet.set, sheet.tile, {}, 0};
        size(alone);
        check_mesh(alone, i, nullptr);
        all.push_back(alone);
      }
    }
    return all;
  }

  const std::vector<Vec2>& uv(const Sheet& sheet, std::uint32_t instance) const {
    return plan_.meshes[instance]->mesh().uv[sheet.set];
  }
  Vec2 uv(const Sheet& sheet, std::uint32_t instance, std::uint32_t t, int k) const {
    return uv(sheet, instance)[plan_.meshes[instance]->vertex(t, k)];
  }

  const std::string& name_of(const Sheet& sheet) const {
    return scene_.objects[scene_.instances[sheet.instances[0]].object].name;
  }

  void remark(std::vector<std::string>& names, const Sheet& sheet) const {
    const std::string& name = name_of(sheet);
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }

  [[noreturn]] void refuse(const Sheet& sheet, const std::string& what) const {
    throw InputError(fmt::format("--uv existing: '{}' {}", name_of(sheet), what),
                     "lay it out without overlap in [0, 1] as TEXCOORD_1, choose others by "
                     "--receivers, or leave --uv out");
  }

  int set_of(const Sheet& sheet) const {
    for (const int set : {1, 0})
      if (std::ranges::none_of(sheet.instances, [&](std::uint32_t i) {
            return plan_.meshes[i]->mesh().uv[set].empty();
          }))
        return set;
    refuse(sheet, "has no texture coordinates");
  }

  /// Layouts may lie in any cell of the whole numbers' grid, since textures repeat.
  void find_tile(Sheet& sheet) const {
    Vec2 lo{INFINITY, INFINITY}, hi{-INFINITY, -INFINITY};
    for (const std::uint32_t i : sheet.instances)
      for (std::uint32_t t = 0; t < plan_.meshes[i]->triangle_count(); ++t)
        for (int k = 0; k < 3; ++k) {
          const Vec2 at = uv(sheet, i, t, k);
          if (!std::isfinite(at.x) || !std::isfinite(at.y))
            refuse(sheet,
                   fmt::format("has coordinates in TEXCOORD_{} that are no numbers", sheet.set));
          lo = {std::min(lo.x, at.x), std::min(lo.y, at.y)};
          hi = {std::max(hi.x, at.x), std::max(hi.y, at.y)};
        }
    sheet.tile = {std::floor(lo.x + beyond), std::floor(lo.y + beyond)};
    if (hi.x > sheet.tile.x + 1 + beyond || hi.y > sheet.tile.y + 1 + beyond)
      refuse(sheet, fmt::format("reaches beyond [0, 1] in TEXCOORD_{}: from ({:.4g}, {:.4g}) to "
                                "({:.4g}, {:.4g})",
                                sheet.set, lo.x, lo.y, hi.x, hi.y));
  }

  /// The page's sides: texels as large as asked for on average, and as long as wide.
  void size(Sheet& sheet) {
    double world = 0, laid = 0, stretch = 0;
    float wanted = options_.texel_size;
    for (const std::uint32_t i : sheet.instances) {
      const WorldMesh& mesh = *plan_.meshes[i];
      std::vector<std::uint32_t> all(mesh.triangle_count());
      for (std::uint32_t t = 0; t < all.size(); ++t) {
        all[t] = t;
        const Vec2 a = uv(sheet, i, t, 0);
        const Vec2 b = uv(sheet, i, t, 1) - a, c = uv(sheet, i, t, 2) - a;
        const double doubled = std::abs(double{cross(b, c)});
        world += mesh.area(t), laid += doubled / 2;
        const Vec3d to_b(mesh.corner(t, 1) - mesh.corner(t, 0));
        const Vec3d to_c(mesh.corner(t, 2) - mesh.corner(t, 0));
        // Metres a unit of u and of v, both times the same.
        const double per_u = length(to_b * double{c.y} - to_c * double{b.y});
        const double per_v = length(to_c * double{b.x} - to_b * double{c.x});
        if (per_u > 0 && per_v > 0) stretch += mesh.area(t) * std::log(per_u / per_v);
      }
      wanted = std::min(wanted, base_color_texel(scene_, mesh, all).value_or(wanted));
    }
    if (!(laid > 0) || !(world > 0))
      refuse(sheet, fmt::format("has no area in TEXCOORD_{}", sheet.set));
    const float finest = options_.finest * options_.texel_size;
    if (wanted < finest) remark(plan_.remarks.blurred, sheet), wanted = finest;
    const double texels = std::sqrt(world / laid) / wanted;
    const double aspect = std::exp(std::clamp(stretch / world, -4.0, 4.0) / 2);
    const auto side = [&](double n) {
      if (n > largest_page) remark(plan_.remarks.coarse, sheet);
      const int whole =
          static_cast<int>(std::clamp<double>(std::ceil(n), fewest_texels, largest_page));
      return power_of_two_ ? static_cast<int>(std::bit_ceil(static_cast<unsigned>(whole))) : whole;
    };
    sheet.page = {side(texels * aspect), side(texels / aspect)};
    sheet.texel_size = static_cast<float>(
        std::sqrt(world / laid / (double{1} * sheet.page.width * sheet.page.height)));
  }

  Vec2 texels(const Sheet& sheet, std::uint32_t instance, std::uint32_t t, int k) const {
    const Vec2 at = uv(sheet, instance, t, k) - sheet.tile;
    return {at.x * static_cast<float>(sheet.page.width),
            at.y * static_cast<float>(sheet.page.height)};
  }

  /// Checks the meshes each; true if they do not claim one another's texels.
  bool is_shared_well(const Sheet& sheet) {
    ClaimedTexels all(sheet.page.width, sheet.page.height);
    std::size_t alone = 0;
    for (const std::uint32_t i : sheet.instances) alone += check_mesh(sheet, i, &all);
    const UvOverlap& found = all.overlap();
    return static_cast<double>(found.contested - alone) <=
           most_contested * static_cast<double>(found.covered);
  }

  /// The texels that it claims twice, which are few.
  std::size_t check_mesh(const Sheet& sheet, std::uint32_t instance, ClaimedTexels* all) {
    const WorldMesh& mesh = *plan_.meshes[instance];
    std::vector<LaidTriangle> laid(mesh.triangle_count());
    std::size_t flat = 0;
    float flat_area = 0, area = 0;
    for (std::uint32_t t = 0; t < laid.size(); ++t) {
      for (int k = 0; k < 3; ++k) laid[t].corner[k] = texels(sheet, instance, t, k);
      const auto& [a, b, c] = laid[t].corner;
      area += mesh.area(t);
      if (mesh.area(t) < sheet.texel_size * sheet.texel_size ||
          std::abs(cross(b - a, c - a)) >= 2 * least_texels)
        continue;
      ++flat, flat_area += mesh.area(t);
    }
    if (flat_area > most_flat * area)
      refuse(sheet, fmt::format("has {} of {} triangles without area in TEXCOORD_{}", flat,
                                laid.size(), sheet.set));
    ClaimedTexels own(sheet.page.width, sheet.page.height);
    own.add(laid);
    if (all) all->add(laid);
    const UvOverlap& found = own.overlap();
    if (static_cast<double>(found.contested) > most_contested * static_cast<double>(found.covered))
      refuse_overlap(sheet, instance, found);
    if (flat > 0 || found.contested > 0) remark(plan_.remarks.squeezed, sheet);
    return found.contested;
  }

  [[noreturn]] void refuse_overlap(const Sheet& sheet, std::uint32_t instance,
                                   const UvOverlap& found) const {
    const Vec2 at = uv(sheet, instance, static_cast<std::uint32_t>(found.b), 0);
    refuse(sheet, fmt::format("overlaps itself in TEXCOORD_{} on {:.3g} % of its texels: triangles "
                              "{} and {}, near ({:.4g}, {:.4g})",
                              sheet.set,
                              100.0 * static_cast<double>(found.contested) /
                                  static_cast<double>(found.covered),
                              found.a, found.b, at.x, at.y));
  }

  void add_page(const Sheet& sheet, bool back) {
    const auto number = static_cast<int>(plan_.placed->pages.size());
    bool is_used = false;
    for (const std::uint32_t i : sheet.instances) {
      if (back && !plan_.backs[i]) continue;
      is_used = true;
      add_charts(sheet, i, back, number);
    }
    if (!is_used) return;
    plan_.placed->pages.push_back(sheet.page);
    plan_.placed->areas.push_back({number, 0, 0, sheet.page.width, sheet.page.height});
  }

  void add_charts(const Sheet& sheet, std::uint32_t instance, bool back, int page) {
    const WorldMesh& mesh = *plan_.meshes[instance];
    TriangleIds curved;
    std::vector<bool> planar(mesh.triangle_count());
    for (const TriangleIds& part : coplanar_parts(mesh, *adjacencies_[instance]))
      for (const std::uint32_t t : add_flat(sheet, instance, back, page, part)) planar[t] = true;
    for (std::uint32_t t = 0; t < planar.size(); ++t)
      if (!planar[t]) curved.push_back(t);
    if (!curved.empty()) add_curved(sheet, instance, back, page, curved);
  }

  /// Charts of the triangles of a plane; returns those that are in one.
  TriangleIds add_flat(const Sheet& sheet, std::uint32_t instance, bool back, int page,
                       TriangleIds part) {
    const WorldMesh& mesh = *plan_.meshes[instance];
    TriangleIds done;
    for (int i = 0; i < most_flat_charts && !part.empty(); ++i) {
      const std::optional<FlatLayout> layout = flat_layout(sheet, instance, part.front());
      if (!layout) break;
      const auto others = std::ranges::stable_partition(part, [&](std::uint32_t t) {
        for (int k = 0; k < 3; ++k) {
          const Vec2 d = layout->uv(mesh.corner(t, k)) - uv(sheet, instance, t, k);
          if (std::hypot(d.x * static_cast<float>(sheet.page.width),
                         d.y * static_cast<float>(sheet.page.height)) > affine_error)
            return false;
        }
        return true;
      });
      const TriangleIds same(part.begin(), others.begin());
      part.assign(others.begin(), others.end());
      if (same.empty()) break;
      CutChart chart = windowed(sheet, instance, back, same);
      PlanarChart& shape = chart.shape;
      const UvWindow& w = *shape.uv;
      shape.base = layout->point(w.corner);
      shape.edge_x = Vec3(layout->per_u * double{w.size.x});
      shape.edge_y = Vec3(layout->per_v * double{w.size.y});
      shape.normal = mesh.normal(same.front()) * (back ? -1.0f : 1.0f);
      place(std::move(chart), page, sheet);
      done.insert(done.end(), same.begin(), same.end());
    }
    return done;
  }

  std::optional<FlatLayout> flat_layout(const Sheet& sheet, std::uint32_t instance,
                                        std::uint32_t t) const {
    const WorldMesh& mesh = *plan_.meshes[instance];
    const Vec2 a = uv(sheet, instance, t, 0);
    const Vec2 b = uv(sheet, instance, t, 1) - a, c = uv(sheet, instance, t, 2) - a;
    const double doubled = double{b.x} * c.y - double{b.y} * c.x;
    const double texels = std::abs(doubled) * sheet.page.width * sheet.page.height;
    if (!(texels > 2 * double{least_texels})) return {};
    FlatLayout out;
    out.origin = Vec3d(mesh.corner(t, 0)), out.corner = a;
    const Vec3d to_b = Vec3d(mesh.corner(t, 1)) - out.origin;
    const Vec3d to_c = Vec3d(mesh.corner(t, 2)) - out.origin;
    out.per_u = (to_b * double{c.y} - to_c * double{b.y}) / doubled;
    out.per_v = (to_c * double{b.x} - to_b * double{c.x}) / doubled;
    const Vec3d n = penumbra::cross(out.per_u, out.per_v);
    if (!(dot(n, n) > 0)) return {};
    out.x = penumbra::cross(out.per_v, n) / dot(n, n);
    out.y = penumbra::cross(n, out.per_u) / dot(n, n);
    return out;
  }

  void add_curved(const Sheet& sheet, std::uint32_t instance, bool back, int page,
                  const TriangleIds& triangles) {
    const WorldMesh& mesh = *plan_.meshes[instance];
    CutChart chart = windowed(sheet, instance, back, triangles);
    chart.flat = false;
    Vec3 sum;
    std::vector<Vec3> corners;
    for (const std::uint32_t t : triangles) {
      sum += mesh.normal(t) * mesh.area(t);
      for (int k = 0; k < 3; ++k) corners.push_back(mesh.corner(t, k));
    }
    const Vec3 front = length(sum) > 0 ? normalize(sum) : mesh.normal(triangles.front());
    PlanarChart& shape = chart.shape;
    shape.normal = back ? -front : front;
    const Parallelogram p = fit_parallelogram(corners, shape.normal);
    shape.base = p.base, shape.edge_x = p.edge_x, shape.edge_y = p.edge_y;
    place(std::move(chart), page, sheet);
  }

  /// All but its place in the world.
  CutChart windowed(const Sheet& sheet, std::uint32_t instance, bool back,
                    const TriangleIds& triangles) const {
    Vec2 lo{INFINITY, INFINITY}, hi{-INFINITY, -INFINITY};
    for (const std::uint32_t t : triangles)
      for (int k = 0; k < 3; ++k) {
        const Vec2 p = texels(sheet, instance, t, k);
        lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
        hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
      }
    const auto [width, height] = sheet.page;
    const auto first = [](float x, int n) {
      return std::clamp(static_cast<int>(std::floor(x - reach)), 0, n - 1);
    };
    const auto last = [](float x, int n) {
      return std::clamp(static_cast<int>(std::ceil(x + reach)), 1, n);
    };
    const int x = first(lo.x, width), y = first(lo.y, height);
    CutChart chart;
    PlanarChart& shape = chart.shape;
    shape.instance = instance, shape.triangles = triangles, shape.back = back;
    shape.width = last(hi.x, width) - x, shape.height = last(hi.y, height) - y;
    const auto w = static_cast<float>(width), h = static_cast<float>(height);
    shape.uv = UvWindow{
        sheet.set,
        {sheet.tile.x + static_cast<float>(x) / w, sheet.tile.y + static_cast<float>(y) / h},
        {static_cast<float>(shape.width) / w, static_cast<float>(shape.height) / h},
        sheet.tile};
    chart.texel_size = sheet.texel_size;
    return chart;
  }

  void place(CutChart chart, int page, const Sheet& sheet) {
    const Vec2 at = chart.shape.uv->corner - sheet.tile;
    const auto whole = [](float x, int n) {
      return static_cast<int>(std::lround(x * static_cast<float>(n)));
    };
    plan_.placed->places.push_back(
        {page, whole(at.x, sheet.page.width), whole(at.y, sheet.page.height), false});
    plan_.charts.push_back(std::move(chart));
  }

  const Scene& scene_;
  const std::vector<std::unique_ptr<Adjacency>>& adjacencies_;
  const ChartOptions& options_;
  bool power_of_two_;
  Plan& plan_;
};

}  // namespace

void lay_out_by_uv(const Scene& scene, const std::vector<std::unique_ptr<Adjacency>>& adjacencies,
                   const ChartOptions& options, bool power_of_two, Plan& plan) {
  Layout(scene, adjacencies, options, power_of_two, plan).run();
}

}  // namespace penumbra::bake
