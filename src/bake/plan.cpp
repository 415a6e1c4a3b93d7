#include "bake/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bake/atlas.h"
#include "bake/uv_layout.h"
#include "base/cancel.h"
#include "base/error.h"
#include "base/parallel.h"

namespace penumbra::bake {
namespace {

constexpr double default_texels = 1 << 22;
// A texel kept: value and two marks; in the page that is filled: colour, alpha, mark, code; of a
// chart at work: value, place and a point for rays, for each thread and sample; between passes: two
// sums and a place, for each sample.
constexpr double kept_bytes = 14, page_bytes = 24, work_bytes = 80, pass_bytes = 44;

float default_texel_size(const Plan& plan) {
  double area = 0;
  for (std::size_t i = 0; i < plan.meshes.size(); ++i) {
    if (!plan.receives[i]) continue;
    for (std::uint32_t t = 0; t < plan.meshes[i]->triangle_count(); ++t)
      area += plan.meshes[i]->area(t) * (plan.backs[i] ? 2.0 : 1.0);
  }
  return static_cast<float>(std::sqrt(area / default_texels));
}

/// With texels `coarser` times as large.
double needed_bytes(const Plan& plan, const TextureOptions& options, double coarser) {
  double texels = 0, largest = 0;
  for (const CutChart& chart : plan.charts) {
    const auto side = [&](const Vec3& edge, int now) {
      const double n = chart.shape.uv ? std::ceil(now / coarser)
                                      : std::ceil(length(edge) / (chart.texel_size * coarser));
      return std::clamp(n, 2.0, static_cast<double>(largest_page - 2 * gutter));
    };
    const double n =
        side(chart.shape.edge_x, chart.shape.width) * side(chart.shape.edge_y, chart.shape.height);
    texels += n, largest = std::max(largest, n);
  }
  double page = std::min(texels * 1.3, static_cast<double>(largest_page) * largest_page);
  if (plan.placed)
    for (const AtlasPage& p : plan.placed->pages)
      page = std::max(page, double{1} * p.width * p.height / (coarser * coarser));
  const double at_work = std::min(largest * thread_count(), texels);
  const double samples = options.supersample * options.supersample;
  return kept_bytes * texels + page_bytes * page + work_bytes * samples * at_work +
         (options.in_passes ? pass_bytes * samples * texels : 0);
}

/// How many times as large texels must be for every chart to fit into a page.
double needed_by_pages(const Plan& plan) {
  constexpr double most = largest_page - 2 * gutter;
  double coarser = 0;
  for (const CutChart& chart : plan.charts)
    for (const Vec3& edge : {chart.shape.edge_x, chart.shape.edge_y})
      if (!chart.shape.uv)
        coarser = std::max(coarser, static_cast<double>(length(edge) / plan.texel_size) / most);
  return coarser;
}

/// A texel size of three digits, not below `size`.
std::string rounded_up(double size) {
  const double step = std::pow(10, std::floor(std::log10(size)) - 2);
  return fmt::format("{:.3g}", std::ceil(size / step * (1 - 1e-9)) * step);
}

/// Texels that a person asked for must fit into pages, all must into memory.
void check_size(const Plan& plan, const TextureOptions& options) {
  const auto most = static_cast<double>(options.most_bytes);
  const double needed = needed_bytes(plan, options, 1), by_pages = needed_by_pages(plan);
  const bool exceeds_page = options.texel_size && by_pages > 1,
             exceeds_memory = most > 0 && needed > most;
  if (!exceeds_page && !exceeds_memory) return;
  double coarser = exceeds_page ? by_pages : 1;
  while (most > 0 && needed_bytes(plan, options, coarser) > 0.95 * most && coarser < 1e6)
    coarser *= 1.05;
  const std::string fits = rounded_up(plan.texel_size * coarser);
  if (exceeds_page)
    throw InputError(
        fmt::format("--texel-size: texels of {:.3g} m are {:.0f} along a side of a surface, and a "
                    "texture holds {}",
                    plan.texel_size, std::ceil(by_pages * (largest_page - 2 * gutter)),
                    largest_page - 2 * gutter),
        fmt::format("give --texel-size {} or cut the surface into parts", fits));
  throw InputError(
      fmt::format("--texel-size: texels of {:.3g} m need {:.0f} MB of memory and {:.0f} MB may be "
                  "taken",
                  plan.texel_size, needed / 1e6, most / 1e6),
      fmt::format("give --texel-size {}, or more by --max-memory", fits));
}

ChartOptions chart_options(const Plan& plan) {
  ChartOptions options;
  options.texel_size = plan.texel_size;
  options.most_texels = largest_page - 2 * gutter;
  return options;
}

void cut(const Scene& scene, const std::vector<std::unique_ptr<Adjacency>>& adjacencies,
         Plan& plan) {
  const std::size_t count = plan.meshes.size();
  std::vector<std::vector<CutChart>> charts(count);
  std::vector<ChartRemarks> remarks(count);
  const ChartOptions options = chart_options(plan);
  parallel_for(count, [&](std::size_t i) {
    if (!plan.receives[i]) return;
    for (const bool back : {false, true}) {
      if (back && !plan.backs[i]) continue;
      auto some = cut_charts(scene, *plan.meshes[i], *adjacencies[i], back, options, remarks[i]);
      std::ranges::move(some, std::back_inserter(charts[i]));
    }
  });
  const auto append = [](std::vector<std::string>& to, const std::vector<std::string>& from) {
    for (const std::string& name : from)
      if (std::ranges::find(to, name) == to.end()) to.push_back(name);
  };
  for (std::size_t i = 0; i < count; ++i) {
    std::ranges::move(charts[i], std::back_inserter(plan.charts));
    append(plan.remarks.coarse, remarks[i].coarse);
    append(plan.remarks.blurred, remarks[i].blurred);
  }
}

/// Cutting into very many texels takes long: whether `finer` ones than the default fit is seen from
/// charts of that first.
void check_early(const Scene& scene, const std::vector<std::unique_ptr<Adjacency>>& adjacencies,
                 const TextureOptions& options, float finer, Plan& plan) {
  plan.texel_size = default_texel_size(plan);
  cut(scene, adjacencies, plan);
  plan.texel_size *= finer;
  for (CutChart& chart : plan.charts) chart.texel_size *= finer;
  check_size(plan, options);
  plan.charts.clear();
  plan.remarks = {};
}

}  // namespace

std::uint64_t Plan::texel_count() const {
  std::uint64_t sum = 0;
  for (const CutChart& chart : charts)
    sum += static_cast<std::uint64_t>(chart.shape.width) *
           static_cast<std::uint64_t>(chart.shape.height);
  return sum;
}

Plan make_plan(const Scene& scene, const TextureOptions& options) {
  Plan plan;
  plan.receives = receivers_of(scene, options.receivers);
  const std::size_t count = scene.instances.size();
  plan.meshes.resize(count);
  std::vector<std::unique_ptr<Adjacency>> adjacencies(count);
  std::vector<std::uint8_t> backs(count);
  parallel_for(count, [&](std::size_t i) {
    plan.meshes[i] = std::make_unique<WorldMesh>(scene, static_cast<std::uint32_t>(i));
    adjacencies[i] = std::make_unique<Adjacency>(*plan.meshes[i]);
    backs[i] = has_back(scene, *plan.meshes[i], *adjacencies[i]);
  });
  plan.backs.assign(backs.begin(), backs.end());
  const float by_itself = default_texel_size(plan), wanted = options.texel_size.value_or(by_itself);
  if (wanted < by_itself / 4 && !options.existing_uv)
    check_early(scene, adjacencies, options, wanted / by_itself, plan);
  plan.texel_size = wanted;
  if (options.existing_uv)
    lay_out_by_uv(scene, adjacencies, chart_options(plan), options.power_of_two, plan);
  else
    cut(scene, adjacencies, plan);
  check_size(plan, options);
  return plan;
}

}  // namespace penumbra::bake
