#include "render/field_tile.h"

#include <algorithm>
#include <numbers>

#include "render/pixel_samples.h"
#include "render/tile_order.h"
#include "sdf/field.h"

namespace penumbra {
namespace {

bool is_plainly_diffuse(const Material& m) {
  return !m.is_metallic_roughness && !(max_component(m.specular) > 0) &&
         !(max_component(m.mirror) > 0) && !m.diffuse_map.used() && !m.emission_map.used();
}

bool wants_layers(const RenderOptions& o) {
  return o.want_visibility || o.want_depth || o.want_normal || o.want_steps || o.want_error;
}

}  // namespace

/// What is known of a part of a tile, side by side; one for a thread.
struct FieldTiles::Points {
  /// A quarter of a tile, so that they stay near the processor.
  static constexpr unsigned at_once = Tile::size * Tile::size / 4;

  std::vector<Ray> rays;
  std::vector<float*> pixels;  ///< of the rays
  SolidHits hits;
  std::vector<Receiver> receivers;  ///< of the hits
  std::vector<DiffuseColor> colors;
  std::vector<Vec3> radiance;
  // Of those that a light can brighten:
  std::vector<std::uint32_t> lit;
  std::vector<float> irradiance;
  std::vector<Receiver> asked;
  std::vector<std::uint64_t> streams;
  std::vector<Visibility> seen;
};

std::optional<FieldTiles> FieldTiles::of(const RenderSetup& setup) {
  const Scene& scene = setup.world.scene();
  const bool by_fraction =
      !setup.options.known && !setup.shadows.sums_light_points() && !setup.shadows.adaptive();
  if (!setup.world.has_only_solids() || !by_fraction || wants_layers(setup.options) ||
      !std::ranges::all_of(scene.materials, is_plainly_diffuse))
    return std::nullopt;
  // From within a solid rays see black, each by itself where they have no eye in common.
  if (setup.camera.orthographic() || setup.world.is_inside(setup.camera.origin()))
    return std::nullopt;
  FieldTiles tiles;
  for (const Material& m : scene.materials)
    tiles.colors_.push_back({m.diffuse, m.emission, m.double_sided});
  return tiles;
}

void FieldTiles::set_color(const World& world, const SolidHits& hits, std::size_t i,
                           DiffuseColor& out) const {
  const auto& owner = hits.owner[i];
  if (!owner.blended) {
    out = colors_[owner.material];
    return;
  }
  out = {};
  for (const auto& part : world.solids().surface(hits.position[i]).parts) {
    out.diffuse += colors_[part.material].diffuse * part.weight;
    out.emission += colors_[part.material].emission * part.weight;
  }
}

void FieldTiles::add_light(const RenderSetup& setup, std::size_t light, Points& p,
                           ShadowCounts& counts) const {
  const Horizon horizon = horizon_of(setup.shadows);
  p.lit.clear(), p.irradiance.clear(), p.asked.clear();
  for (std::size_t i = 0; i < p.receivers.size(); ++i) {
    if (!(max_component(p.colors[i].diffuse) > 0)) continue;
    const Receiver& r = p.receivers[i];
    const float irradiance = setup.lights.irradiance(light, r.position, r.normal, horizon);
    if (!(irradiance > 0)) continue;
    p.lit.push_back(static_cast<std::uint32_t>(i));
    p.irradiance.push_back(irradiance);
    p.asked.push_back(r);
  }
  p.seen.resize(p.lit.size()), p.streams.resize(p.lit.size());
  setup.shadows.visibilities(p.asked, light, p.streams, p.seen, counts);
  const Vec3& emission = setup.lights.emission(light);
  for (std::size_t k = 0; k < p.lit.size(); ++k) {
    const float arriving = p.irradiance[k] * std::numbers::inv_pi_v<float> * p.seen[k].fraction;
    p.radiance[p.lit[k]] += emission * (p.colors[p.lit[k]].diffuse * arriving);
  }
}

void FieldTiles::render_part(const RenderSetup& setup, const Tile& tile, int sample, unsigned first,
                             Points& p, RenderResult& result, TileCounts& counts) const {
  const Scene& scene = setup.world.scene();
  const int spp = setup.options.spp;
  const Vec2 at = pixel_sample(sample, spp);
  p.rays.resize(Points::at_once), p.pixels.resize(Points::at_once);
  std::size_t count = 0;
  for (unsigned code = first; code < first + Points::at_once; ++code) {
    const int x = tile.x0 + tile_order[code].x, y = tile.y0 + tile_order[code].y;
    if (x >= tile.x1 || y >= tile.y1) continue;
    p.rays[count] = setup.camera.at(static_cast<float>(x) + at.x, static_cast<float>(y) + at.y).ray;
    p.pixels[count++] = result.color.at(x, y);
  }
  p.rays.resize(count);
  counts.primary_rays += p.rays.size();
  counts.unfinished_rays += setup.world.meet_solids(p.rays, p.hits);
  const std::size_t met = p.hits.ray.size();
  p.receivers.resize(met), p.colors.resize(met), p.radiance.resize(met);
  for (std::size_t i = 0; i < met; ++i) {
    const Vec3& n = p.hits.normal[i];
    const bool front = dot(n, p.rays[p.hits.ray[i]].direction) < 0;
    p.receivers[i].position = p.hits.position[i];
    p.receivers[i].normal = front ? n : -n;
    set_color(setup.world, p.hits, i, p.colors[i]);
    if (!front && !p.colors[i].double_sided) p.colors[i].emission = {};
    p.radiance[i] = setup.ambient * p.colors[i].diffuse;
  }
  for (std::size_t light = 0; light < setup.lights.size(); ++light)
    add_light(setup, light, p, counts.shadows);
  const float share = 1 / static_cast<float>(spp);
  const auto add = [share](float* pixel, const Vec3& radiance) {
    for (int c = 0; c < 3; ++c) pixel[c] += radiance[c] * share;
  };
  std::size_t next = 0;
  for (std::size_t i = 0; i < p.rays.size(); ++i) {
    if (next < met && p.hits.ray[next] == i)
      add(p.pixels[i], p.radiance[next] + p.colors[next].emission), ++next;
    else
      add(p.pixels[i], scene.background);
  }
}

TileCounts FieldTiles::render(const RenderSetup& setup, const Tile& tile,
                              RenderResult& result) const {
  thread_local Points points;
  TileCounts counts;
  for (int sample = 0; sample < setup.options.spp; ++sample)
    for (unsigned first = 0; first < tile_order.size(); first += Points::at_once)
      render_part(setup, tile, sample, first, points, result, counts);
  return counts;
}

}  // namespace penumbra
