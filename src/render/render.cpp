#include "render/render.h"

#include <chrono>
#include <mutex>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "render/exposure.h"
#include "render/field_tile.h"
#include "render/tile_renderer.h"

namespace penumbra {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void check(const Scene& scene, const RenderOptions& o) {
  if (o.width < 1 || o.height < 1)
    throw InputError(fmt::format("a picture of {}x{} pixels has no pixel", o.width, o.height),
                     "give a size of at least 1x1");
  if (o.spp < 1)
    throw InputError(fmt::format("{} samples per pixel show nothing", o.spp), "give at least 1");
  if (o.camera < 0 || static_cast<std::size_t>(o.camera) >= scene.cameras.size())
    throw InputError(fmt::format("there is no camera {}", o.camera),
                     fmt::format("the scene has {}, numbered from 0", scene.cameras.size()));
}

/// The error asked for is a pixel's: each of its independent samples may have √spp times that.
ShadowOptions shadow_options(const RenderOptions& o) {
  ShadowOptions shadows = o.shadows;
  if (shadows.error) *shadows.error *= std::sqrt(static_cast<float>(o.spp));
  return shadows;
}

RenderResult empty_result(const RenderOptions& o, std::size_t lights) {
  RenderResult result;
  result.color = Image(o.width, o.height, 3);
  if (o.want_visibility) result.visibility.assign(lights, Image(o.width, o.height, 1));
  if (o.want_depth) result.depth = Image(o.width, o.height, 1);
  if (o.want_normal) result.normal = Image(o.width, o.height, 3);
  if (o.want_steps) result.steps = Image(o.width, o.height, 1);
  if (o.want_error) result.error = Image(o.width, o.height, 1);
  return result;
}

/// Tiles cover the picture row by row.
class Tiling {
 public:
  Tiling(int width, int height)
      : width_(width), height_(height), across_(tiles(width)), down_(tiles(height)) {}

  std::size_t count() const { return across_ * down_; }
  Tile tile(std::size_t i) const {
    const int x0 = static_cast<int>(i % across_) * Tile::size;
    const int y0 = static_cast<int>(i / across_) * Tile::size;
    return {x0, y0, std::min(width_, x0 + Tile::size), std::min(height_, y0 + Tile::size)};
  }

 private:
  static std::size_t tiles(int pixels) {
    return (static_cast<std::size_t>(pixels) + Tile::size - 1) / Tile::size;
  }

  int width_, height_;
  std::size_t across_, down_;
};

void render_tiles(const RenderSetup& setup, RenderResult& result, Progress& progress) {
  const Tiling tiling(setup.options.width, setup.options.height);
  std::mutex mutex;
  std::uint64_t blind_rays = 0;
  const std::optional<FieldTiles> field = FieldTiles::of(setup);
  progress.start("render", tiling.count());
  parallel_for(tiling.count(), [&](std::size_t i) {
    thread_local TileScratch scratch;
    const Tile tile = tiling.tile(i);
    const TileCounts counts =
        field ? field->render(setup, tile, result) : render_tile(setup, tile, scratch, result);
    {
      const std::lock_guard lock(mutex);
      result.stats.primary_rays += counts.primary_rays;
      result.stats.mirror_rays += counts.mirror_rays;
      result.stats.shadows += counts.shadows;
      result.stats.unfinished_rays += counts.unfinished_rays;
      blind_rays += counts.blind_rays;
    }
    progress.advance(1);
  });
  progress.finish();
  if (blind_rays > 0) result.warnings.emplace_back(warning_of_blind_eye);
}

}  // namespace

RenderResult render(const World& world, const RenderOptions& options, Progress& progress) {
  const Scene& scene = world.scene();
  check(scene, options);
  const auto build_start = Clock::now();
  RenderResult result = empty_result(options, scene.lights.size());
  result.warnings = world.warnings();
  const Shadows shadows(world, shadow_options(options));
  const DirectLight lights(shadows.lights());
  const MaterialLookup materials(scene);
  const Camera& view = scene.cameras[static_cast<std::size_t>(options.camera)];
  const CameraRays camera(view, options.width, options.height);
  const CameraRays coarse(view, exposure_grid_width, exposure_grid_height);
  const std::optional<float> exposure_ev =
      options.exposure_ev ? options.exposure_ev : scene.exposure_ev;
  const bool is_given = exposure_ev && !scene.ambient_is_automatic;
  const Brightness bright = is_given ? Brightness{*exposure_ev, scene.ambient}
                                     : find_brightness(world, coarse, lights, materials);
  result.stats.exposure_ev = exposure_ev.value_or(bright.exposure_ev);
  result.stats.seconds_build = seconds_since(build_start);
  const auto render_start = Clock::now();
  render_tiles({world, options, lights, materials, shadows, camera, bright.ambient}, result,
               progress);
  result.stats.seconds_render = seconds_since(render_start);
  return result;
}

}  // namespace penumbra
