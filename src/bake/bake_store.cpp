#include "bake/bake_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bake/assemble.h"
#include "bake/file_materials.h"
#include "bake/light_key.h"
#include "bake/sample_file.h"
#include "base/cancel.h"
#include "base/error.h"
#include "base/parallel.h"
#include "image/png_bytes.h"

namespace penumbra::bake {
namespace {

/// One light's lit parts, in all three channels.
class LitParts final : public Irradiance {
 public:
  LitParts(const BakedIrradiance& all, std::size_t light) : all_(all), light_(light) {}
  void of_chart(const PlanarChart& chart, std::span<Vec3> out) const override { get(chart, out); }
  void of_points(std::span<const SurfacePoint> points, std::span<Vec3> out) const override {
    get(points, out);
  }

 private:
  template <class Where>
  void get(const Where& where, std::span<Vec3> out) const {
    std::vector<float> found(out.size());
    all_.lit_parts(where, light_, found);
    std::ranges::transform(found, out.begin(), [](float x) { return Vec3(x); });
  }

  const BakedIrradiance& all_;
  std::size_t light_;
};

/// The visible fractions of one chart, as 8-bit codes.
struct ChartFractions {
  std::vector<std::vector<std::uint8_t>> by_light;
  std::vector<std::uint8_t> is_known;
};

Json::Value array_of(const Vec3& v) {
  Json::Value a(Json::arrayValue);
  for (int i = 0; i < 3; ++i) a.append(static_cast<double>(v[i]));
  return a;
}

/// What of a surface is looked up by a file's page, not by a lightmap; and highlights and mirrors
/// that glTF has no word for. page −1: none.
void mark(const Material& in, int page, Json::Value& material) {
  material["extensions"].removeMember("MOZ_lightmap");
  if (material["extensions"].empty()) material.removeMember("extensions");
  if (page < 0 && in.is_metallic_roughness) return;
  Json::Value& extras = material["extras"]["penumbra"];
  if (page >= 0) extras["page"] = page;
  if (in.is_metallic_roughness) return;
  extras["diffuse"] = array_of(in.diffuse), extras["specular"] = array_of(in.specular);
  extras["mirror"] = array_of(in.mirror);
  extras["roughness"] = static_cast<double>(in.roughness);
}

class StoreBake {
 public:
  StoreBake(const BakeInput& input, const BakedIrradiance& sight, const Plan& plan,
            const TextureOptions& options, Store store, Progress& progress)
      : input_(input),
        scene_(input.scene),
        sight_(sight),
        plan_(plan),
        options_(options),
        store_(store),
        progress_(progress) {}

  Baked run() {
    check();
    place();
    assemble();
    if (store_ == Store::visibility)
      store_fractions();
    else
      store_samples();
    baked_.model.nodes = assembly_.take();
    baked_.model.cameras = scene_.cameras;
    baked_.model.lights = scene_.lights;
    baked_.model.lights_are_baked = false;
    describe();
    return std::move(baked_);
  }

 private:
  void check() const {
    for (const Light& light : scene_.lights)
      if (light.type == LightType::segment)
        throw InputError(
            fmt::format("--store: glTF has no word for the segment light \"{}\"", light.name),
            "leave --store out, or make it a thin rect light");
    if (store_ != Store::samples) return;
    if (options_.supersample > 1)
      throw InputError("--supersample: samples are stored for one point a texel",
                       "leave it out, or give --store visibility");
    if (plan_.placed)
      throw InputError("--uv: samples are stored for charts of our own alone",
                       "leave it out, or give --store visibility");
    if (sight_.options().device == BakeDevice::gl)
      throw InputError("--device: OpenGL adds samples up and keeps none for --store samples",
                       "choose cpu, rays or auto");
  }

  bool emits(const PlanarChart& shape) const {
    return scene_.instances[shape.instance].mesh_light >= 0;
  }

  void place() {
    if (plan_.placed) placed_.pages = plan_.placed->pages, placed_.areas = plan_.placed->areas;
    for (std::size_t i = 0; i < plan_.charts.size(); ++i) {
      if (emits(plan_.charts[i].shape)) continue;
      charts_.push_back(plan_.charts[i]);
      if (plan_.placed) placed_.places.push_back(plan_.placed->places[i]);
    }
    if (!plan_.placed) placed_ = place_charts(charts_, options_.power_of_two);
    BakeStats& stats = baked_.stats;
    stats.charts = charts_.size(), stats.pages = placed_.pages.size();
    for (const CutChart& chart : charts_) stats.texels += texels_of(chart.shape);
  }

  static std::uint64_t texels_of(const PlanarChart& shape) {
    return static_cast<std::uint64_t>(shape.width) * static_cast<std::uint64_t>(shape.height);
  }

  void assemble() {
    LightmapMaterials materials(scene_, 0, input_.source, baked_.model);
    for (std::size_t i = 0; i < charts_.size(); ++i) {
      const ChartPlace& place = placed_.places[i];
      const std::uint32_t instance = charts_[i].shape.instance;
      const int material = material_of(instance, place.page, plan_.backs[instance], materials);
      assembly_.add_textured(charts_[i], place, placed_.pages[static_cast<std::size_t>(place.page)],
                             material, true);
    }
    for (std::uint32_t i = 0; i < plan_.meshes.size(); ++i)
      if (!plan_.receives[i] || scene_.instances[i].mesh_light >= 0)
        assembly_.add_plain(i, false, {}, material_of(i, -1, false, materials), true);
  }

  int material_of(std::uint32_t instance, int page, bool one_sided, LightmapMaterials& materials) {
    const std::uint32_t material = scene_.instances[instance].material;
    const int number = materials.find(material, page, one_sided);
    mark(scene_.materials[material], page,
         baked_.model.materials[static_cast<Json::ArrayIndex>(number)]);
    return number;
  }

  /// Calls light(chart number) for all, large ones first.
  template <class LightChart>
  void light_all(const LightChart& light) {
    std::vector<std::size_t> order(charts_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, std::greater{},
                             [&](std::size_t i) { return texels_of(charts_[i].shape); });
    progress_.start("bake", baked_.stats.texels);
    parallel_for(order.size(), [&](std::size_t k) {
      light(order[k]);
      progress_.advance(texels_of(charts_[order[k]].shape));
    });
    progress_.finish();
  }

  const WorldMesh& mesh_of(const CutChart& chart) const {
    return *plan_.meshes[chart.shape.instance];
  }

  void store_fractions() {
    std::vector<ChartFractions> found(charts_.size());
    const SurfaceLight surface(scene_, input_.materials, {});
    LightOptions options;
    options.quantity = Quantity::irradiance;
    options.supersample = options_.supersample;
    light_all([&](std::size_t i) {
      for (std::size_t l = 0; l < scene_.lights.size(); ++l) {
        const LitParts parts(sight_, l);
        LitChart lit = light_chart(charts_[i], mesh_of(charts_[i]), parts, surface, options);
        auto& codes = found[i].by_light.emplace_back();
        for (const Vec3& value : lit.texels.value)
          codes.push_back(static_cast<std::uint8_t>(std::clamp(value.x, 0.0f, 1.0f) * 255 + 0.5f));
        found[i].is_known = std::move(lit.texels.is_known);
      }
    });
    const std::size_t lights = scene_.lights.size();
    progress_.start("write", placed_.pages.size() * lights);
    for (std::size_t l = 0; l < lights; ++l) {
      Json::Value light = light_key(scene_.lights[l]);
      light["name"] = scene_.lights[l].name;
      light["textures"] = Json::arrayValue;
      for (std::size_t p = 0; p < placed_.pages.size(); ++p) {
        light["textures"].append(add_texture(l, page_of(found, l, static_cast<int>(p))));
        progress_.advance(1);
      }
      store()["lights"].append(light);
    }
    progress_.finish();
  }

  Image page_of(const std::vector<ChartFractions>& found, std::size_t light, int number) const {
    throw_if_cancelled();
    Page page(placed_.pages[static_cast<std::size_t>(number)]);
    for (std::size_t i = 0; i < charts_.size(); ++i) {
      if (placed_.places[i].page != number) continue;
      ChartTexels texels;
      texels.is_known = found[i].is_known;
      for (const std::uint8_t code : found[i].by_light[light])
        texels.value.emplace_back(static_cast<float>(code) / 255);
      page.put(charts_[i], placed_.places[i], texels);
    }
    for (const PlacedCharts::Area& area : placed_.areas)
      if (area.page == number) page.fill(area);
    Image grey(page.color().width, page.color().height, 1);
    for (std::size_t i = 0; i < grey.data.size(); ++i) grey.data[i] = page.color().data[3 * i];
    return grey;
  }

  int add_texture(std::size_t light, const Image& fractions) {
    GlbModel& model = baked_.model;
    Json::Value texture;
    texture["source"] = static_cast<int>(model.images.size()), texture["sampler"] = 0;
    model.images.push_back(
        {fmt::format("visibility of light {}", light), encode_grey_png(fractions)});
    model.textures.append(texture);
    return static_cast<int>(model.textures.size()) - 1;
  }

  void store_samples() {
    check_memory();
    std::vector<ChartSight> found(charts_.size());
    light_all([&](std::size_t i) {
      const auto places = samples_of(charts_[i], mesh_of(charts_[i]), 1).places;
      found[i] = chart_sight(charts_[i], mesh_of(charts_[i]), sight_, places);
    });
    SampleWriter writer(scene_.lights.size());
    for (std::size_t i = 0; i < charts_.size(); ++i) {
      const PlanarChart& shape = charts_[i].shape;
      writer.add(placed_.places[i], shape.width, shape.height, found[i]);
      found[i] = {};
    }
    baked_.model.samples = writer.bytes();
    for (const Light& light : scene_.lights) {
      Json::Value key = light_key(light);
      key["name"] = light.name;
      store()["lights"].append(key);
    }
  }

  /// The bits are there three times while the file is put together.
  void check_memory() const {
    double bits = 0;
    for (const CutChart& chart : charts_)
      for (const int count : sight_.sample_counts(chart.shape, {}))
        bits += static_cast<double>(count) * static_cast<double>(texels_of(chart.shape));
    const double needed = 3 * bits / 8, most = static_cast<double>(options_.most_bytes);
    if (most == 0 || needed <= most) return;
    throw InputError(
        fmt::format("--store samples: one bit for each texel and light sample needs {:.0f} MB of "
                    "memory and {:.0f} MB may be taken",
                    needed / 1e6, most / 1e6),
        fmt::format("give --texel-size {:.3g}, fewer --light-samples, or more by --max-memory",
                    static_cast<double>(plan_.texel_size) * std::sqrt(1.05 * needed / most)));
  }

  Json::Value& store() { return baked_.model.extras["store"]; }

  void describe() {
    Json::Value& extras = baked_.model.extras;
    extras["version"] = 1;
    for (int i = 0; i < 3; ++i) {
      extras["background"].append(static_cast<double>(scene_.background[i]));
      extras["ambient"].append(static_cast<double>(input_.ambient[i]));
    }
    store()["kind"] = store_ == Store::visibility ? "visibility" : "samples";
    store()["texCoord"] = 1;
    if (!store().isMember("lights")) store()["lights"] = Json::arrayValue;
    store()["pages"] = Json::arrayValue;
    for (const AtlasPage& page : placed_.pages) {
      Json::Value size;
      size.append(page.width), size.append(page.height);
      store()["pages"].append(size);
    }
  }

  const BakeInput& input_;
  const Scene& scene_;
  const BakedIrradiance& sight_;
  const Plan& plan_;
  const TextureOptions& options_;
  Store store_;
  Progress& progress_;
  std::vector<CutChart> charts_;  // of surfaces that do not emit
  PlacedCharts placed_;
  Assembly assembly_{scene_, plan_};
  Baked baked_;
};

}  // namespace

Baked bake_store(const BakeInput& input, const BakedIrradiance& sight, const Plan& plan,
                 const TextureOptions& options, Store store, Progress& progress) {
  return StoreBake(input, sight, plan, options, store, progress).run();
}

}  // namespace penumbra::bake
