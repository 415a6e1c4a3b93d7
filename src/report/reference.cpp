#include "report/reference.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <mutex>

#include "base/parallel.h"
#include "render/camera_rays.h"

namespace penumbra::report {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto between_saves = std::chrono::seconds(20);
constexpr int tile_side = 16;

std::size_t tiles_across(int pixels) {
  return (static_cast<std::size_t>(pixels) + tile_side - 1) / tile_side;
}

struct Area {
  int x0, y0, x1, y1;
};

Area area_of(const Reference& r, std::size_t tile) {
  const std::size_t across = tiles_across(r.width);
  const int x = static_cast<int>(tile % across) * tile_side;
  const int y = static_cast<int>(tile / across) * tile_side;
  return {x, y, std::min(x + tile_side, r.width), std::min(y + tile_side, r.height)};
}

/// In order of pixels.
std::vector<PixelReceiver> receivers_in(const World& world, const CameraRays& camera,
                                        const Area& area, int width) {
  std::vector<Ray> rays;
  std::vector<std::size_t> pixels;
  for (int y = area.y0; y < area.y1; ++y)
    for (int x = area.x0; x < area.x1; ++x) {
      const Ray ray = camera.at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f).ray;
      if (world.is_inside(ray.origin)) continue;
      rays.push_back(ray);
      pixels.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(x));
    }
  std::vector<std::optional<Hit>> hits(rays.size());
  constexpr std::size_t at_once = 8;
  for (std::size_t i = 0; i < rays.size(); i += at_once)
    world.intersect(std::span(rays).subspan(i, std::min(at_once, rays.size() - i)), &hits[i]);
  std::vector<PixelReceiver> found;
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (hits[i]) found.push_back({pixels[i], receiver_of(world.surface(rays[i], *hits[i]))});
  return found;
}

/// Those whose points all agree, unlike a neighbour's: an edge may nick their light unseen.
std::vector<std::size_t> doubtful(std::span<const PixelReceiver> receivers,
                                  std::span<const PointReference> found, const Area& area,
                                  int width) {
  constexpr int side = tile_side + 2;
  constexpr float unknown = -1;
  std::array<float, side * side> grid;
  grid.fill(unknown);
  const auto place = [&](std::size_t i) {
    const auto pixel = static_cast<int>(receivers[i].pixel);
    return static_cast<std::size_t>((pixel / width - area.y0 + 1) * side + pixel % width - area.x0 +
                                    1);
  };
  for (std::size_t i = 0; i < receivers.size(); ++i) grid[place(i)] = found[i].fraction;
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const float f = found[i].fraction;
    if (found[i].points == 0 || (f > 0 && f < 1)) continue;
    const std::size_t at = place(i);
    bool differs = false;
    for (const std::size_t row : {at - side, at, at + side})
      for (const std::size_t neighbour : {row - 1, row, row + 1})
        differs = differs || (grid[neighbour] != unknown && grid[neighbour] != f);
    if (differs) out.push_back(i);
  }
  return out;
}

struct TileResult {
  std::vector<PixelReceiver> receivers;
  std::vector<PointReference> at;  ///< by light, then receiver
  ShadowCounts counts;
};

TileResult work_out(const World& world, const CameraRays& camera, const ReferencePoints& points,
                    const Reference& reference, std::size_t tile) {
  TileResult result;
  result.receivers = receivers_in(world, camera, area_of(reference, tile), reference.width);
  const std::size_t n = result.receivers.size();
  result.at.resize(n * reference.lights);
  for (std::size_t light = 0; light < reference.lights; ++light) {
    const std::span found = std::span(result.at).subspan(light * n, n);
    const auto ask = [&](std::size_t i, int least) {
      const PixelReceiver& p = result.receivers[i];
      found[i] = points.at(p.receiver, light, p.pixel, least, result.counts);
    };
    for (std::size_t i = 0; i < n; ++i) ask(i, ReferencePoints::first_points);
    for (const std::size_t i :
         doubtful(result.receivers, found, area_of(reference, tile), reference.width))
      ask(i, ReferencePoints::points_at_edges);
  }
  return result;
}

void put(const TileResult& result, std::size_t tile, Reference& reference) {
  const std::size_t n = result.receivers.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t pixel = result.receivers[i].pixel;
    reference.surface[pixel] = 1;
    for (std::size_t light = 0; light < reference.lights; ++light)
      reference.at[light * reference.pixels() + pixel] = result.at[light * n + i];
  }
  reference.rays += result.counts.rays;
  reference.tiles[tile] = 1;
}

/// Adds up the time since the last look.
class Stopwatch {
 public:
  double lap() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - begin_).count();
    begin_ = now;
    return seconds;
  }
  bool is_due() const { return Clock::now() - begin_ > between_saves; }

 private:
  Clock::time_point begin_ = Clock::now();
};

}  // namespace

bool Reference::complete() const {
  return !color.data.empty() && std::find(tiles.begin(), tiles.end(), 0) == tiles.end();
}

Reference empty_reference(const ReferenceOptions& options, std::size_t lights) {
  Reference r;
  r.width = options.width, r.height = options.height, r.lights = lights;
  r.surface.resize(r.pixels());
  r.at.resize(lights * r.pixels());
  r.tiles.resize(tiles_across(r.width) * tiles_across(r.height));
  return r;
}

ReferenceQuality quality_of(const Reference& reference, float target) {
  ReferenceQuality q;
  std::size_t pixels = 0, within = 0;
  double points = 0;
  for (std::size_t pixel = 0; pixel < reference.pixels(); ++pixel) {
    if (!reference.surface[pixel]) continue;
    ++pixels;
    bool all = true;
    for (std::size_t light = 0; light < reference.lights; ++light) {
      const PointReference& p = reference.point(light, pixel);
      all = all && p.standard_error < target;
      points += p.points;
      q.points_most = std::max(q.points_most, p.points);
    }
    within += all;
  }
  if (pixels == 0) return {1, 0, 0};
  q.share_within = static_cast<double>(within) / static_cast<double>(pixels);
  q.points_mean = points / static_cast<double>(pixels * std::max<std::size_t>(reference.lights, 1));
  return q;
}

std::vector<PixelReceiver> receivers_of(const World& world, const ReferenceOptions& options) {
  const CameraRays camera(world.scene().cameras[static_cast<std::size_t>(options.camera)],
                          options.width, options.height);
  std::vector<std::vector<PixelReceiver>> rows(static_cast<std::size_t>(options.height));
  parallel_for(rows.size(), [&](std::size_t y) {
    const int row = static_cast<int>(y);
    rows[y] = receivers_in(world, camera, {0, row, options.width, row + 1}, options.width);
  });
  std::vector<PixelReceiver> all;
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

void complete_reference(const World& world, const ReferenceOptions& options, Reference& reference,
                        const std::function<void(const Reference&)>& save, Progress& progress) {
  const CameraRays camera(world.scene().cameras[static_cast<std::size_t>(options.camera)],
                          options.width, options.height);
  const ReferencePoints points(world, options.target, options.seed);
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < reference.tiles.size(); ++i)
    if (!reference.tiles[i]) missing.push_back(i);
  std::mutex mutex;
  Stopwatch watch;
  progress.start("reference", missing.size());
  try {
    parallel_for(missing.size(), [&](std::size_t i) {
      const TileResult result = work_out(world, camera, points, reference, missing[i]);
      progress.advance(1);
      const std::lock_guard lock(mutex);
      put(result, missing[i], reference);
      if (!watch.is_due()) return;
      reference.seconds += watch.lap();
      save(reference);
    });
  } catch (...) {
    reference.seconds += watch.lap();
    save(reference);
    throw;
  }
  reference.seconds += watch.lap();
  progress.finish();
}

}  // namespace penumbra::report
