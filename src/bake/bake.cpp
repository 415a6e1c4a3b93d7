#include "bake/bake.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bake/assemble.h"
#include "bake/file_materials.h"
#include "base/cancel.h"
#include "base/error.h"
#include "base/parallel.h"
#include "image/png_bytes.h"

namespace penumbra::bake {
namespace {

constexpr float vertex_error = 1;  // steps of 8 bits

std::uint64_t texels_of(const CutChart& chart) {
  return static_cast<std::uint64_t>(chart.shape.width) *
         static_cast<std::uint64_t>(chart.shape.height);
}

/// Lights charts one after another, large ones first, so that none is left over for one thread at
/// the end.
class AllAtOnce {
 public:
  AllAtOnce(const BakeInput& input, const Plan& plan, const SurfaceLight& surface,
            const LightOptions& options, Progress& progress)
      : input_(input),
        plan_(plan),
        surface_(surface),
        options_(options),
        progress_(progress),
        order_(plan.charts.size()),
        lit_(plan.charts.size()),
        is_lit_(plan.charts.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::ranges::stable_sort(order_, std::greater{},
                             [&](std::size_t i) { return texels_of(plan.charts[i]); });
  }

  std::vector<LitChart> run(BakeStats& stats) {
    progress_.start("bake", plan_.texel_count());
    try {
      light(input_.irradiance);
    } catch (const Cancelled&) {
      if (!input_.finish_early || !input_.finish_early()) throw;
      light_others(stats);
    }
    progress_.finish();
    return std::move(lit_);
  }

 private:
  void light_others(BakeStats& stats) {
    PassOptions passes;
    passes.deadline = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    for (std::size_t i = 0; i < is_lit_.size(); ++i)
      if (!is_lit_[i]) passes.only.push_back(i);
    if (passes.only.empty()) return;
    LitCharts lit = light_in_passes(plan_, *input_.hasty, surface_, options_, passes, progress_);
    for (const std::size_t i : passes.only) lit_[i] = std::move(lit.charts[i]);
    stats.hasty_charts = passes.only.size();
    stats.light_points = lit.points;
  }

  void light(const Irradiance& irradiance) {
    parallel_for(order_.size(), [&](std::size_t k) {
      const std::size_t i = order_[k];
      const CutChart& chart = plan_.charts[i];
      lit_[i] =
          light_chart(chart, *plan_.meshes[chart.shape.instance], irradiance, surface_, options_);
      is_lit_[i] = 1;
      progress_.advance(texels_of(chart));
    });
  }

  const BakeInput& input_;
  const Plan& plan_;
  const SurfaceLight& surface_;
  const LightOptions& options_;
  Progress& progress_;
  std::vector<std::size_t> order_;
  std::vector<LitChart> lit_;
  std::vector<std::uint8_t> is_lit_;
};

/// Irradiance without shadows, by DirectLight, composed at every vertex of one side.
std::vector<Vec3> unshadowed_colors(const BakeInput& input, const WorldMesh& mesh, bool back) {
  const SurfaceLight surface(input.scene, input.materials, input.ambient);
  std::vector<Vec3> colors(mesh.positions().size());
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const MeshPoint at{t, k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f, back};
      const SurfacePoint point = surface_point(mesh, at);
      Vec3 irradiance;
      for (std::size_t light = 0; light < input.lights.size(); ++light)
        irradiance +=
            input.lights.emission(light) *
            input.lights.irradiance(light, point.position, point.shading_normal, Horizon::exact);
      colors[mesh.vertex(t, k)] = surface.radiance(mesh, at, irradiance, std::sqrt(mesh.area(t))) *
                                  std::exp2(input.exposure_ev);
    }
  return colors;
}

/// Fills pages one after another, so that one alone takes memory.
class Pages {
 public:
  Pages(const Plan& plan, const std::vector<std::size_t>& textured, std::vector<LitChart>& lit,
        const PlacedCharts& placed)
      : plan_(plan), textured_(textured), lit_(lit), placed_(placed) {}

  Page fill(int number) {
    Page page(placed_.pages[static_cast<std::size_t>(number)]);
    for (std::size_t i = 0; i < textured_.size(); ++i) {
      if (placed_.places[i].page != number) continue;
      page.put(plan_.charts[textured_[i]], placed_.places[i], lit_[textured_[i]].texels);
      lit_[textured_[i]].texels = {};
    }
    for (const PlacedCharts::Area& area : placed_.areas)
      if (area.page == number) page.fill(area);
    return page;
  }

 private:
  const Plan& plan_;
  const std::vector<std::size_t>& textured_;
  std::vector<LitChart>& lit_;
  const PlacedCharts& placed_;
};

Image with_alpha(const Page& page) {
  Image out(page.color().width, page.color().height, 4);
  for (std::size_t i = 0; i < page.alpha().data.size(); ++i) {
    std::copy_n(&page.color().data[3 * i], 3, &out.data[4 * i]);
    out.data[4 * i + 3] = page.alpha().data[i];
  }
  return out;
}

bool has_holes(const Page& page) {
  return std::ranges::any_of(page.alpha().data, [](float a) { return a < 1; });
}

float brightest(const Image& image) {
  const float most = *std::ranges::max_element(image.data);
  return most > 0 ? most : 1.0f;
}

class Bake {
 public:
  Bake(const BakeInput& input, const Plan& plan, const TextureOptions& options, Output output)
      : input_(input), plan_(plan), options_(options), output_(output) {}

  Baked run(const PageSink& sink, Progress& progress) {
    light(progress);
    place();
    if (output_ == Output::radiance)
      assemble_radiance();
    else
      assemble_lightmap();
    progress.start("write", placed_.pages.size());
    write_pages(sink, progress);
    progress.finish();
    baked_.model.nodes = assembly_.take();
    baked_.model.cameras = input_.scene.cameras;
    if (output_ == Output::lightmap) finish_lightmap();
    describe();
    return std::move(baked_);
  }

 private:
  void light(Progress& progress) {
    const SurfaceLight surface(input_.scene, input_.materials, input_.ambient);
    if (!input_.refined) {
      const LightOptions options = light_options();
      lit_ = AllAtOnce(input_, plan_, surface, options, progress).run(baked_.stats);
      return;
    }
    LitCharts lit =
        light_in_passes(plan_, *input_.refined, surface, light_options(), passes(), progress);
    lit_ = std::move(lit.charts);
    baked_.stats.light_points = lit.points;
  }

  PassOptions passes() const {
    PassOptions options = input_.passes;
    options.finish_early = input_.finish_early;
    return options;
  }

  LightOptions light_options() const {
    LightOptions light;
    light.supersample = options_.supersample;
    light.exposure_ev = input_.exposure_ev;
    if (output_ == Output::lightmap)
      light.quantity = Quantity::irradiance;
    else if (!plan_.placed)
      light.vertex_error = vertex_error;
    return light;
  }

  void place() {
    std::vector<CutChart> charts;
    BakeStats& stats = baked_.stats;
    for (std::size_t i = 0; i < lit_.size(); ++i) {
      stats.texels += texels_of(plan_.charts[i]);
      if (lit_[i].has_texels()) {
        textured_.push_back(i);
        charts.push_back(plan_.charts[i]);
      } else {
        ++stats.vertex_charts;
        stats.saved_texels += texels_of(plan_.charts[i]);
      }
    }
    placed_ = plan_.placed ? *plan_.placed : place_charts(charts, options_.power_of_two);
    stats.charts = lit_.size();
    stats.pages = placed_.pages.size();
  }

  const Object& object_of(std::uint32_t instance) const {
    return input_.scene.objects[input_.scene.instances[instance].object];
  }
  const Material& material_of(std::uint32_t instance) const {
    return input_.scene.materials[input_.scene.instances[instance].material];
  }

  /// Calls visit(instance, back) for each side that is not baked.
  template <class Visit>
  void for_plain_sides(const Visit& visit) {
    for (std::uint32_t i = 0; i < plan_.meshes.size(); ++i) {
      if (plan_.receives[i]) continue;
      visit(i, false);
      if (plan_.backs[i]) visit(i, true);
    }
  }

  void assemble_radiance() {
    GlbModel& model = baked_.model;
    for (std::size_t i = 0; i < placed_.pages.size(); ++i) {
      Json::Value texture;
      texture["source"] = static_cast<int>(i), texture["sampler"] = 0;
      model.textures.append(texture);
      model.images.push_back({"radiance " + std::to_string(i), {}});
    }
    UnlitMaterials materials(model);
    const float scale = std::exp2(input_.exposure_ev);
    std::size_t next = 0;
    for (std::size_t i = 0; i < lit_.size(); ++i) {
      const CutChart& chart = plan_.charts[i];
      if (!lit_[i].has_texels()) {
        assembly_.add_colored(chart, lit_[i].vertices, scale, materials.find(-1, {}));
        continue;
      }
      const ChartPlace& place = placed_.places[next++];
      const int material =
          materials.find(place.page, material_of(chart.shape.instance).alpha_cutoff);
      assembly_.add_textured(chart, place, placed_.pages[static_cast<std::size_t>(place.page)],
                             material, false);
    }
    for_plain_sides([&](std::uint32_t i, bool back) {
      assembly_.add_plain(i, back, unshadowed_colors(input_, *plan_.meshes[i], back),
                          materials.find(-1, {}), false);
    });
  }

  void assemble_lightmap() {
    materials_.emplace(input_.scene, static_cast<int>(placed_.pages.size()), input_.source,
                       baked_.model);
    std::size_t next = 0;
    for (const CutChart& chart : plan_.charts) {
      const ChartPlace& place = placed_.places[next++];
      const std::uint32_t instance = chart.shape.instance;
      const int material = materials_->find(input_.scene.instances[instance].material, place.page,
                                            plan_.backs[instance]);
      assembly_.add_textured(chart, place, placed_.pages[static_cast<std::size_t>(place.page)],
                             material, true);
    }
    for (std::uint32_t i = 0; i < plan_.meshes.size(); ++i)
      if (!plan_.receives[i])
        assembly_.add_plain(i, false, {},
                            materials_->find(input_.scene.instances[i].material, -1, false), true);
  }

  void write_pages(const PageSink& sink, Progress& progress) {
    Pages pages(plan_, textured_, lit_, placed_);
    for (std::size_t i = 0; i < placed_.pages.size(); ++i) {
      const Page page = pages.fill(static_cast<int>(i));
      if (cancel_requested && !(input_.finish_early && input_.finish_early())) throw Cancelled();
      std::string& png = baked_.model.images[i].bytes;
      if (output_ == Output::lightmap) {
        intensities_.push_back(brightest(page.color()));
        png = encode_linear_png(page.color(), intensities_.back());
      } else {
        png = has_holes(page) ? encode_png(with_alpha(page), input_.exposure_ev)
                              : encode_png(page.color(), input_.exposure_ev);
      }
      if (sink) sink(static_cast<int>(i), placed_.pages.size(), page.color());
      progress.advance(1);
    }
  }

  void finish_lightmap() {
    materials_->set_intensities(intensities_);
    baked_.model.lights = input_.scene.lights;
    for (Light& light : baked_.model.lights)
      if (light.type == LightType::mesh && light.name == "mesh")
        light.name = object_of(static_cast<std::uint32_t>(light.instance)).name;
    Json::Value& out = baked_.description;
    out["unit"] = "irradiance, W/m² per channel, linear sRGB primaries";
    for (std::size_t i = 0; i < intensities_.size(); ++i) {
      Json::Value image;
      image["image"] = static_cast<int>(i);
      image["intensity"] = static_cast<double>(intensities_[i]);
      image["encoding"] = "linear, 16 bits, texel · intensity is irradiance";
      out["images"].append(image);
    }
    for (const Assembly::Part& part : assembly_.parts()) {
      const Json::Value& material =
          baked_.model.materials[static_cast<Json::ArrayIndex>(part.material)];
      if (!material["extensions"].isMember("MOZ_lightmap")) continue;
      Json::Value mesh;
      mesh["mesh"] = part.node;
      mesh["primitive"] = static_cast<Json::UInt64>(part.primitive);
      mesh["image"] = material["extensions"]["MOZ_lightmap"]["index"];
      mesh["texCoord"] = 1;
      out["meshes"].append(mesh);
    }
  }

  void describe() {
    Json::Value& extras = baked_.model.extras;
    extras["version"] = 1;
    if (output_ == Output::radiance)
      extras["exposure_ev"] = static_cast<double>(input_.exposure_ev);
    for (int i = 0; i < 3; ++i)
      extras["background"].append(static_cast<double>(input_.scene.background[i]));
  }

  const BakeInput& input_;
  const Plan& plan_;
  const TextureOptions& options_;
  Output output_;
  std::vector<LitChart> lit_;
  std::vector<std::size_t> textured_;  // charts with texels
  PlacedCharts placed_;                // of those
  Assembly assembly_{input_.scene, plan_};
  std::optional<LightmapMaterials> materials_;
  std::vector<float> intensities_;
  Baked baked_;
};

}  // namespace

Baked bake(const BakeInput& input, const Plan& plan, const TextureOptions& options, Output output,
           const PageSink& sink, Progress& progress) {
  return Bake(input, plan, options, output).run(sink, progress);
}

}  // namespace penumbra::bake
