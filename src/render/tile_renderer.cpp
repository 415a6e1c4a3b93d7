#include "render/tile_renderer.h"

#include "render/hash.h"
#include "render/pixel_samples.h"
#include "render/tile_aovs.h"
#include "render/tile_order.h"

namespace penumbra {
namespace {

constexpr float least_throughput = 1.0f / 500;

/// Sample `sample` of pixels of the tile, those of [first, first + count) in Morton's order so that
/// neighbours stay together. Pixels are numbered over the whole picture, so that tiles leave no
/// trace. Rays that begin inside a distance field are left out: they see black. Returns how many
/// those are.
std::uint64_t primary_rays(const RenderSetup& setup, const Tile& tile, int sample, unsigned first,
                           unsigned count, std::vector<TileRay>& rays) {
  const RenderOptions& o = setup.options;
  const float beam_share = 1 / std::sqrt(static_cast<float>(o.spp));
  const Vec2 at = pixel_sample(sample, o.spp);
  const bool one_eye = !setup.camera.orthographic();
  bool is_blind = one_eye && setup.world.is_inside(setup.camera.origin());
  std::uint64_t blind = 0;
  rays.clear();
  for (unsigned code = first; code < first + count; ++code) {
    const int x = tile.x0 + tile_order[code].x, y = tile.y0 + tile_order[code].y;
    if (x >= tile.x1 || y >= tile.y1) continue;
    const auto number = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(o.width) +
                        static_cast<std::uint64_t>(x);
    TileRay ray;
    ray.beam = setup.camera.at(static_cast<float>(x) + at.x, static_cast<float>(y) + at.y);
    if (!one_eye) is_blind = setup.world.is_inside(ray.beam.ray.origin);
    blind += is_blind;
    if (is_blind) continue;
    ray.beam.width *= beam_share;
    ray.beam.spread *= beam_share;
    ray.pixel = static_cast<std::uint32_t>((y - tile.y0) * tile.width() + x - tile.x0);
    ray.stream = mix64(mix64(number, o.seed), static_cast<std::uint64_t>(sample));
    rays.push_back(ray);
  }
  return blind;
}

void set_point(TilePoint& point, const TileRay& ray, const Hit& hit, const Surface& surface,
               const MaterialLookup& materials) {
  point.width = ray.beam.width + ray.beam.spread * hit.t;
  point.spread = ray.beam.spread;
  point.shading = materials.at(surface, -ray.beam.ray.direction, point.width);
  point.receiver = receiver_of(surface);
  point.primitive = surface.primitive;
  point.normal = surface.normal;
  point.throughput = ray.throughput;
  point.t = hit.t;
  point.pixel = ray.pixel;
  point.stream = ray.stream;
}

/// The mirrored direction; where the shading normal would send it into the surface, it is turned
/// back out.
Vec3 mirrored(const TilePoint& point) {
  const Vec3 &n = point.shading.normal, &v = point.shading.to_viewer;
  const Vec3 r = n * (2 * dot(n, v)) - v;
  const float out = dot(r, point.normal);
  return normalize(out > 0 ? r : r - point.normal * (2.001f * out));
}

void mirror_rays(const World& world, std::span<const TilePoint> points,
                 std::vector<TileRay>& rays) {
  rays.clear();
  for (const TilePoint& point : points) {
    const Vec3 throughput = point.throughput * point.shading.mirror;
    if (!(max_component(throughput) > least_throughput)) continue;
    TileRay ray;
    const Vec3& p = point.shading.position;
    ray.beam.ray.origin = p + point.normal * (4 * world.epsilon_at(p));
    ray.beam.ray.direction = mirrored(point);
    ray.beam.width = point.width;
    ray.beam.spread = point.spread;
    ray.throughput = throughput;
    ray.pixel = point.pixel;
    ray.stream = mix64(point.stream);
    rays.push_back(ray);
  }
}

/// Adds to a tile's pixels of the colour image.
class PixelSums {
 public:
  PixelSums(const Tile& tile, int spp, Image& image)
      : tile_(tile), image_(image), share_(1 / static_cast<float>(spp)) {}

  void add(std::uint32_t pixel, const Vec3& radiance) {
    const int i = static_cast<int>(pixel);
    float* rgb = image_.at(tile_.x0 + i % tile_.width(), tile_.y0 + i / tile_.width());
    for (int c = 0; c < 3; ++c) rgb[c] += radiance[c] * share_;
  }

 private:
  const Tile& tile_;
  Image& image_;
  float share_;
};

/// What the rays that met nothing see. `points` are those of the others, in the rays' order.
void add_background(const Vec3& background, std::span<const TileRay> rays,
                    std::span<const TilePoint> points, PixelSums& sums) {
  auto met = points.begin();
  for (const TileRay& ray : rays) {
    if (met != points.end() && met->pixel == ray.pixel)
      ++met;
    else
      sums.add(ray.pixel, background * ray.throughput);
  }
}

/// Rays of one generation, at most one for each pixel, are traced and shaded.
void shade_generation(const RenderSetup& setup, int tile_width, ArrivalObserver* observer,
                      TileScratch& scratch, PixelSums& sums, ShadowCounts& counts) {
  const Scene& scene = setup.world.scene();
  add_background(scene.background, scratch.rays, scratch.points, sums);
  scratch.shader.shade(setup.lights, setup.shadows, setup.options.known, setup.ambient,
                       scratch.points, tile_width, scratch.radiance, observer, counts);
  for (std::size_t i = 0; i < scratch.points.size(); ++i) {
    const TilePoint& p = scratch.points[i];
    sums.add(p.pixel, p.throughput * (scratch.radiance[i] + p.shading.emission));
  }
}

}  // namespace

std::uint64_t trace(const World& world, const MaterialLookup& materials,
                    std::span<const TileRay> rays, std::vector<TilePoint>& points) {
  // Embree takes eight at a time; marches fill their lanes again from all that there are, and 256
  // stay near the processor.
  const std::size_t at_once = world.has_solids() ? 256 : 8;
  thread_local std::vector<Ray> asked;
  thread_local std::vector<std::optional<Hit>> hits;
  thread_local std::vector<Hit> met;
  thread_local std::vector<std::uint32_t> which;
  thread_local std::vector<Surface> surfaces;
  points.resize(rays.size());
  asked.resize(at_once), hits.resize(at_once);
  std::size_t count = 0;
  std::uint64_t lost = 0;
  for (std::size_t first = 0; first < rays.size(); first += at_once) {
    const auto some = rays.subspan(first, std::min(at_once, rays.size() - first));
    for (std::size_t i = 0; i < some.size(); ++i) asked[i] = some[i].beam.ray;
    lost += world.intersect({asked.data(), some.size()}, hits.data());
    met.clear(), which.clear();
    for (std::size_t i = 0; i < some.size(); ++i) {
      if (!hits[i]) continue;
      asked[met.size()] = asked[i];
      met.push_back(*hits[i]);
      which.push_back(static_cast<std::uint32_t>(i));
    }
    surfaces.resize(std::max(surfaces.size(), met.size()));
    const std::span found(surfaces.data(), met.size());
    world.surfaces({asked.data(), met.size()}, met, found);
    for (std::size_t i = 0; i < met.size(); ++i)
      set_point(points[count++], some[which[i]], met[i], found[i], materials);
  }
  points.resize(count);
  return lost;
}

TileCounts render_tile(const RenderSetup& setup, const Tile& tile, TileScratch& scratch,
                       RenderResult& result) {
  const RenderOptions& o = setup.options;
  TileCounts counts;
  TileAovs aovs(setup, tile, scratch.squared_errors, result);
  PixelSums sums(tile, o.spp, result.color);
  constexpr unsigned all = Tile::size * Tile::size;
  // Marches share nothing: a quarter of the tile's points at a time stay near the processor.
  const bool small_parts = setup.shadows.marches_field() || setup.world.has_only_solids();
  const unsigned at_once = small_parts ? all / 4 : all;
  for (unsigned part = 0; part < static_cast<unsigned>(o.spp) * (all / at_once); ++part) {
    const auto sample = static_cast<int>(part / (all / at_once));
    counts.blind_rays +=
        primary_rays(setup, tile, sample, part % (all / at_once) * at_once, at_once, scratch.rays);
    counts.primary_rays += scratch.rays.size();
    for (int depth = 0;; ++depth) {
      counts.unfinished_rays += trace(setup.world, setup.materials, scratch.rays, scratch.points);
      if (depth == 0) aovs.met(scratch.points);
      shade_generation(setup, tile.width(), depth == 0 && aovs.wants_arrivals() ? &aovs : nullptr,
                       scratch, sums, counts.shadows);
      if (depth == o.mirror_depth) break;
      mirror_rays(setup.world, scratch.points, scratch.rays);
      if (scratch.rays.empty()) break;
      counts.mirror_rays += scratch.rays.size();
    }
  }
  aovs.finish();
  return counts;
}

}  // namespace penumbra
