#include "baked_light.h"

#include <algorithm>

#include "bake/receivers.h"
#include "bake/triangulate.h"
#include "base/parallel.h"
#include "memory.h"
#include "prepare.h"

namespace penumbra::app {
namespace {

bake::BakeOptions options_of(const Arguments& arguments, bake::BakeDevice device) {
  bake::BakeOptions options;
  options.device = device;
  options.placement = arguments.bake.light.placement;
  options.light_samples = arguments.render.shadows.light_samples;
  options.seed = arguments.render.seed;
  options.conversions = arguments.conversion;
  return options;
}

bake::TextureOptions textures_of(const Arguments& arguments) {
  bake::TextureOptions textures = arguments.bake.textures;
  if (textures.most_bytes == 0) textures.most_bytes = available_memory() / 2;
  return textures;
}

/// In the tangent plane.
bake::PlanarChart one_texel(const Receiver& r, float size) {
  const Frame f = frame_around(r.normal);
  bake::PlanarChart chart;
  chart.instance = PrimitiveId::none;
  chart.base = r.position - (f.u + f.v) * (size / 2);
  chart.edge_x = f.u * size, chart.edge_y = f.v * size;
  chart.normal = r.normal;
  chart.width = chart.height = 1;
  return chart;
}

}  // namespace

BakedLight::BakedLight(const Scene& scene, const Arguments& arguments, Console& console)
    : scene_(bake::triangulated(scene, arguments.conversion)),
      plan_(bake::make_plan(scene_, textures_of(arguments))),
      world_(scene_, {.cone_tree = false}) {
  bake::BakeOptions samples = options_of(arguments, bake::BakeDevice::automatic);
  samples.instance_scale = bake::samples_scales(scene_);
  const bake::BakedIrradiance irradiance(world_, samples);
  for (const bake::CutChart& chart : plan_.charts)
    for (const int points : irradiance.sample_counts(chart.shape, {}))
      texel_samples_ += static_cast<std::uint64_t>(chart.shape.width) *
                        static_cast<std::uint64_t>(chart.shape.height) *
                        static_cast<std::uint64_t>(points);
  bake::LightTextureOptions options;
  options.visible_fractions = arguments.render.want_visibility;
  light_ = std::make_unique<bake::LightTextures>(scene_, plan_, irradiance, options, console);
}

std::vector<float> baked_fractions(const World& world, const Arguments& arguments,
                                   const std::vector<ProbePoint>& points, Console& console) {
  const bool by_gl = arguments.device == Device::gl;
  const bake::BakedIrradiance irradiance(
      world, options_of(arguments, by_gl ? bake::BakeDevice::gl : bake::BakeDevice::rays));
  const float size = 1e-5f * bounds_of(world.scene()).diagonal();
  std::vector<float> fractions(points.size());
  constexpr std::size_t piece = 64;
  console.start("probe", points.size());
  parallel_for((points.size() + piece - 1) / piece, [&](std::size_t k) {
    const std::size_t last = std::min(points.size(), (k + 1) * piece);
    for (std::size_t i = k * piece; i < last; ++i) {
      const Receiver& r = points[i].receiver;
      if (by_gl) {
        irradiance.visible_fractions(one_texel(r, size), points[i].light, {&fractions[i], 1});
        continue;
      }
      const bake::SurfacePoint point{r.position, r.normal, r.normal, PrimitiveId::none, 0};
      irradiance.visible_fractions({&point, 1}, points[i].light, {&fractions[i], 1});
    }
    console.advance(last - k * piece);
  });
  console.finish();
  return fractions;
}

}  // namespace penumbra::app
