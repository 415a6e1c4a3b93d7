#include "bake/light_textures.h"

#include <algorithm>

#include "bake/light_chart.h"
#include "base/cancel.h"
#include "base/parallel.h"

namespace penumbra::bake {
namespace {

enum class What : std::uint8_t { irradiance, fraction };

/// One light's, in all three channels.
class OfOneLight final : public Irradiance {
 public:
  OfOneLight(const BakedIrradiance& all, std::size_t light, What what)
      : all_(all), light_(light), what_(what) {}

  void of_chart(const PlanarChart& chart, std::span<Vec3> out) const override { get(chart, out); }
  void of_points(std::span<const SurfacePoint> points, std::span<Vec3> out) const override {
    get(points, out);
  }

 private:
  template <class Where>
  void get(const Where& where, std::span<Vec3> out) const {
    std::vector<float> found(out.size());
    if (what_ == What::irradiance)
      all_.unit_irradiances(where, light_, found);
    else
      all_.visible_fractions(where, light_, found);
    std::ranges::transform(found, out.begin(), [](float x) { return Vec3(x); });
  }

  const BakedIrradiance& all_;
  std::size_t light_;
  What what_;
};

/// Bilinear between the texels that are known.
float sample(const std::vector<float>& texels, int width, int height, const Vec2& at) {
  const float x = std::clamp(at.x - 0.5f, 0.0f, static_cast<float>(width - 1));
  const float y = std::clamp(at.y - 0.5f, 0.0f, static_cast<float>(height - 1));
  const int x0 = std::min(static_cast<int>(x), width - 1);
  const int y0 = std::min(static_cast<int>(y), height - 1);
  const float u = x - static_cast<float>(x0), v = y - static_cast<float>(y0);
  float sum = 0, weight = 0;
  for (int k = 0; k < 4; ++k) {
    const int i = std::min(x0 + k % 2, width - 1), j = std::min(y0 + k / 2, height - 1);
    const float value = texels[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(i)];
    const float w = (k % 2 ? u : 1 - u) * (k / 2 ? v : 1 - v);
    if (value >= 0) sum += value * w, weight += w;
  }
  return weight > 0 ? sum / weight : -1.0f;
}

}  // namespace

struct LightTextures::Chart {
  explicit Chart(const PlanarChart& shape)
      : frame(shape), width(shape.width), height(shape.height) {}
  ChartFrame frame;
  int width, height;
  std::size_t number = 0;
};

LightTextures::~LightTextures() = default;

LightTextures::LightTextures(const Scene& scene, const Plan& plan,
                             const BakedIrradiance& irradiance, const LightTextureOptions& options,
                             Progress& progress)
    : scene_(scene), plan_(plan) {
  map_triangles();
  const MaterialLookup materials(scene);
  const SurfaceLight surface(scene, materials, {});
  LightOptions light_options;
  light_options.quantity = Quantity::irradiance;
  light_options.supersample = options.supersample;
  const std::size_t lights = scene.lights.size(), count = plan.charts.size() * lights;
  irradiances_.resize(count);
  if (options.visible_fractions) fractions_.resize(count);
  progress.start("bake", count);
  parallel_for(count, [&](std::size_t i) {
    const CutChart& chart = plan.charts[i / lights];
    const WorldMesh& mesh = *plan.meshes[chart.shape.instance];
    const auto bake = [&](What what, Texels& texels) {
      const OfOneLight one(irradiance, i % lights, what);
      const LitChart lit = light_chart(chart, mesh, one, surface, light_options);
      texels.resize(lit.texels.value.size());
      for (std::size_t k = 0; k < texels.size(); ++k)
        texels[k] = lit.texels.is_known[k] ? lit.texels.value[k].x : -1.0f;
    };
    bake(What::irradiance, irradiances_[i]);
    if (options.visible_fractions) bake(What::fraction, fractions_[i]);
    progress.advance(1);
  });
  progress.finish();
}

void LightTextures::map_triangles() {
  constexpr std::uint32_t none = 0xffffffffu;
  for (auto& side : chart_of_) side.resize(scene_.instances.size());
  for (const CutChart& cut : plan_.charts) {
    const PlanarChart& shape = cut.shape;
    auto& charts = chart_of_[shape.back][shape.instance];
    charts.resize(plan_.meshes[shape.instance]->triangle_count(), none);
    const auto number = static_cast<std::uint32_t>(charts_.size());
    for (const std::uint32_t t : shape.triangles) charts[t] = number;
    charts_.emplace_back(shape);
    charts_.back().number = number;
  }
}

const LightTextures::Chart* LightTextures::find(const TilePoint& point, Vec2& at) const {
  const PrimitiveId id = point.primitive;
  if (id.instance >= scene_.instances.size()) return nullptr;
  const bool back = dot(point.normal, plan_.meshes[id.instance]->normal(id.triangle)) < 0;
  const auto& charts = chart_of_[back][id.instance];
  if (charts.empty() || charts[id.triangle] >= charts_.size()) return nullptr;
  const Chart& chart = charts_[charts[id.triangle]];
  at = chart.frame.texels(point.shading.position);
  return &chart;
}

void LightTextures::look_up(const std::vector<Texels>& textures, std::size_t light,
                            std::span<const TilePoint> points, std::span<float> out) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    Vec2 at;
    const Chart* chart = find(points[i], at);
    out[i] = chart ? sample(textures[chart->number * scene_.lights.size() + light], chart->width,
                            chart->height, at)
                   : -1.0f;
  }
}

void LightTextures::irradiances(std::size_t light, std::span<const TilePoint> points,
                                std::span<float> out) const {
  look_up(irradiances_, light, points, out);
}

void LightTextures::visible_fractions(std::size_t light, std::span<const TilePoint> points,
                                      std::span<float> out) const {
  if (has_visible_fractions())
    look_up(fractions_, light, points, out);
  else
    std::ranges::fill(out, -1.0f);
}

}  // namespace penumbra::bake
